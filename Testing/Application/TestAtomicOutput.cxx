// SPDX-License-Identifier: BSD-3-Clause
// Outputs that appear complete or not at all: after Commit, without it, and after a signal. Signals
// end the process, so that they are sent to children of the test.

#include "CommandLine/CommandErrors.h"
#include "Files/AtomicOutput.h"
#include "Files/Interrupts.h"

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <list>
#include <set>
#include <string>
#include <thread>

#include <sys/wait.h>
#include <unistd.h>

namespace
{

namespace fs = std::filesystem;

constexpr const char* Marker = "results.txt";

/// What a child returns that no signal ended.
constexpr int NotEnded = 99;

void WriteFile(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }

std::string ReadFile(const fs::path& path)
{
  std::ifstream file(path);
  return { std::istreambuf_iterator<char>(file), {} };
}

/// The exit status of a child process that runs a function.
int RunInChild(const std::function<void()>& function)
{
  const pid_t child = fork();
  if (child == 0)
  {
    function();
    _exit(NotEnded);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

class AtomicOutputTest : public testing::Test
{
protected:
  void SetUp() override
  {
    std::string name = (fs::temp_directory_path() / "tetralux-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    this->Folder = name;
  }

  void TearDown() override { fs::remove_all(this->Folder); }

  std::string GetPath(const std::string& name) const { return (this->Folder / name).string(); }

  std::set<std::string> ListFiles() const
  {
    std::set<std::string> names;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(this->Folder))
    {
      names.insert(fs::relative(entry.path(), this->Folder).string());
    }
    return names;
  }

  fs::path Folder;
};

/// A folder with files in folders of its own.
void FillFolder(AtomicOutput& folder)
{
  WriteFile(folder.AddFile(Marker), "");
  for (const char* name : { "a", "b" })
  {
    folder.AddFolder(name);
    folder.AddFolder(std::string(name) + "/deep");
    WriteFile(folder.AddFile(std::string(name) + "/deep/file"), "text");
    WriteFile(folder.AddFile(std::string(name) + "/file"), "text");
  }
  folder.AddFile("never-written");
}

} // namespace

TEST_F(AtomicOutputTest, AFileAppearsWithCommit)
{
  WriteFile(this->GetPath("out.txt"), "old");
  {
    AtomicOutput output(this->GetPath("out.txt"));
    EXPECT_EQ(fs::path(output.GetTemporaryName()).extension(), ".txt");
    WriteFile(output.GetTemporaryName(), "new");
    EXPECT_EQ(ReadFile(this->GetPath("out.txt")), "old");
    output.Commit();
    EXPECT_EQ(ReadFile(this->GetPath("out.txt")), "new");
  }
  EXPECT_EQ(this->ListFiles(), std::set<std::string>{ "out.txt" });
}

TEST_F(AtomicOutputTest, NothingIsLeftWithoutCommit)
{
  {
    AtomicOutput file(this->GetPath("out.txt"));
    AtomicOutput folder(this->GetPath("out"), Marker);
    FillFolder(folder);
    WriteFile(fs::path(folder.AddFile("x")).parent_path() / "not-added", "");
    EXPECT_EQ(this->ListFiles().count("out.txt"), 0u);
    EXPECT_EQ(this->ListFiles().count("out"), 0u);
  }
  EXPECT_EQ(this->ListFiles(), std::set<std::string>{});
}

TEST_F(AtomicOutputTest, AFolderReplacesAnOlderOne)
{
  fs::create_directory(this->GetPath("out"));
  WriteFile(this->GetPath("out/old"), "");
  EXPECT_THROW(AtomicOutput(this->GetPath("out"), Marker), WorkError);
  WriteFile(this->GetPath("out") + "/" + Marker, "");
  AtomicOutput folder(this->GetPath("out") + "/", Marker);
  FillFolder(folder);
  folder.Commit();
  EXPECT_EQ(this->ListFiles(),
    (std::set<std::string>{ "out", std::string("out/") + Marker, "out/a", "out/a/deep",
      "out/a/deep/file", "out/a/file", "out/b", "out/b/deep", "out/b/deep/file", "out/b/file" }));
}

TEST_F(AtomicOutputTest, AFailedCommitKeepsTheOlderOutput)
{
  fs::create_directory(this->GetPath("out"));
  WriteFile(this->GetPath("out") + "/" + Marker, "old");
  WriteFile(this->GetPath("out.txt"), "old");
  AtomicOutput folder(this->GetPath("out"), Marker);
  fs::remove_all(folder.GetTemporaryName());
  EXPECT_THROW(folder.Commit(), WorkError);
  AtomicOutput file(this->GetPath("out.txt"));
  fs::remove(file.GetTemporaryName());
  EXPECT_THROW(file.Commit(), WorkError);
  EXPECT_EQ(ReadFile(this->GetPath("out") + "/" + Marker), "old");
  EXPECT_EQ(ReadFile(this->GetPath("out.txt")), "old");
  EXPECT_EQ(
    this->ListFiles(), (std::set<std::string>{ "out", std::string("out/") + Marker, "out.txt" }));
}

TEST_F(AtomicOutputTest, ASignalRemovesEveryPendingOutput)
{
  for (const int signal : { SIGINT, SIGTERM })
  {
    const int status = RunInChild(
      [&]
      {
        AtomicOutput kept(this->GetPath("kept.txt"));
        WriteFile(kept.GetTemporaryName(), "whole");
        std::list<AtomicOutput> outputs;
        for (int i = 0; i < 20; ++i)
        {
          outputs.emplace_back(this->GetPath("file-" + std::to_string(i)));
          outputs.emplace_back(this->GetPath("folder-" + std::to_string(i)), Marker);
          FillFolder(outputs.back());
        }
        kept.Commit();
        raise(signal);
      });
    EXPECT_EQ(status, 128 + signal);
    EXPECT_EQ(this->ListFiles(), std::set<std::string>{ "kept.txt" });
    EXPECT_EQ(ReadFile(this->GetPath("kept.txt")), "whole");
  }
}

TEST_F(AtomicOutputTest, ASignalWaitsForTheLastHold)
{
  const int status = RunInChild(
    [&]
    {
      AtomicOutput output(this->GetPath("out.txt"));
      const Interrupts::Hold outer;
      {
        const Interrupts::Hold inner;
        raise(SIGTERM);
      }
      WriteFile(this->GetPath("reached"), "");
    });
  EXPECT_EQ(status, 128 + SIGTERM);
  EXPECT_EQ(this->ListFiles(), std::set<std::string>{ "reached" });
}

/// A signal that another thread gets, at any moment of the life of an output.
TEST_F(AtomicOutputTest, ASignalMayComeToAnotherThread)
{
  for (int round = 0; round < 30; ++round)
  {
    const int status = RunInChild(
      [&]
      {
        const AtomicOutput first(this->GetPath("first"));
        std::atomic<int> made(0);
        std::thread other(
          [&]
          {
            while (made < round)
            {
              std::this_thread::yield();
            }
            raise(SIGINT);
          });
        for (;; ++made)
        {
          AtomicOutput file(this->GetPath("file"));
          AtomicOutput folder(this->GetPath("folder"), Marker);
          folder.AddFolder("inner");
        }
      });
    ASSERT_EQ(status, 128 + SIGINT) << "round " << round;
    ASSERT_EQ(this->ListFiles(), std::set<std::string>{}) << "round " << round;
  }
}
