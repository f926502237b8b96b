// SPDX-License-Identifier: BSD-3-Clause
// Outputs that appear complete or not at all: after Commit, without it, and after whatever ends the
// process. That is done to children of the test, which their supervisors watch.

#include "CommandLine/CommandErrors.h"
#include "CommandLine/Supervisor.h"
#include "CommandLine/Worker.h"
#include "Files/AtomicOutput.h"

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
#include <vector>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
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

/// The exit status of a child process that runs a function under supervision. Its line on standard
/// error goes to a file.
int RunInChild(const std::function<void()>& function, const std::string& errors = "/dev/null")
{
  const pid_t child = fork();
  if (child == 0)
  {
    dup2(open(errors.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
    _exit(Supervise(
      [&]
      {
        function();
        return NotEnded;
      }));
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
  {
    AtomicOutput folder(this->GetPath("out") + "/", Marker);
    FillFolder(folder);
    folder.Commit();
  }
  EXPECT_EQ(this->ListFiles(),
    (std::set<std::string>{ "out", std::string("out/") + Marker, "out/a", "out/a/deep",
      "out/a/deep/file", "out/a/file", "out/b", "out/b/deep", "out/b/deep/file", "out/b/file" }));
}

TEST_F(AtomicOutputTest, AFailedCommitKeepsTheOlderOutput)
{
  fs::create_directory(this->GetPath("out"));
  WriteFile(this->GetPath("out") + "/" + Marker, "old");
  {
    AtomicOutput folder(this->GetPath("out"), Marker);
    fs::remove_all(folder.GetTemporaryName());
    EXPECT_THROW(folder.Commit(), WorkError);
    AtomicOutput file(this->GetPath("out.txt"));
    fs::create_directory(this->GetPath("out.txt"));
    EXPECT_THROW(file.Commit(), WorkError);
  }
  EXPECT_EQ(ReadFile(this->GetPath("out") + "/" + Marker), "old");
  EXPECT_EQ(
    this->ListFiles(), (std::set<std::string>{ "out", std::string("out/") + Marker, "out.txt" }));
}

TEST_F(AtomicOutputTest, ManyFilesMayBeOpenAtOnce)
{
  const auto getName = [this](int i) { return this->GetPath("file-" + std::to_string(i)); };
  constexpr int NumberOfFiles = 200;
  rlimit before;
  getrlimit(RLIMIT_NOFILE, &before);
  const rlimit fewer = { NumberOfFiles / 2, before.rlim_max };
  setrlimit(RLIMIT_NOFILE, &fewer);
  {
    std::list<AtomicOutput> outputs;
    for (int i = 0; i < NumberOfFiles; ++i)
    {
      WriteFile(outputs.emplace_back(getName(i)).GetTemporaryName(), std::to_string(i));
    }
    for (AtomicOutput& output : outputs)
    {
      output.Commit();
    }
  }
  setrlimit(RLIMIT_NOFILE, &before);
  EXPECT_EQ(this->ListFiles().size(), static_cast<std::size_t>(NumberOfFiles));
  for (const int i : { 0, 1, NumberOfFiles - 1 })
  {
    EXPECT_EQ(ReadFile(getName(i)), std::to_string(i));
  }
}

TEST_F(AtomicOutputTest, PermissionsAreKeptOrTheUsualOnes)
{
  const mode_t mask = umask(027);
  const auto write = [this](const std::string& name)
  {
    AtomicOutput output(this->GetPath(name));
    output.Commit();
    return fs::status(this->GetPath(name)).permissions();
  };
  EXPECT_EQ(write("new"), fs::perms(0640));
  fs::permissions(this->GetPath("new"), fs::perms(0604));
  EXPECT_EQ(write("new"), fs::perms(0604));
  umask(mask);
}

TEST_F(AtomicOutputTest, LinksAreFollowed)
{
  fs::create_directory(this->GetPath("there"));
  WriteFile(this->GetPath("there/file"), "old");
  fs::create_symlink("there/file", this->GetPath("link"));
  fs::create_symlink("link", this->GetPath("second"));
  fs::create_symlink("there/nothing-yet", this->GetPath("dangling"));
  fs::create_symlink("loop", this->GetPath("loop"));
  for (const char* name : { "second", "dangling" })
  {
    AtomicOutput output(this->GetPath(name));
    WriteFile(output.GetTemporaryName(), "new");
    output.Commit();
    EXPECT_TRUE(fs::is_symlink(this->GetPath(name)));
  }
  EXPECT_EQ(ReadFile(this->GetPath("there/file")), "new");
  EXPECT_EQ(ReadFile(this->GetPath("there/nothing-yet")), "new");
  EXPECT_THROW(AtomicOutput(this->GetPath("loop")), WorkError);
}

TEST_F(AtomicOutputTest, APipeGetsACopy)
{
  ASSERT_EQ(mkfifo(this->GetPath("pipe").c_str(), 0600), 0);
  std::string read;
  std::thread reader([&] { read = ReadFile(this->GetPath("pipe")); });
  {
    AtomicOutput output(this->GetPath("pipe"));
    WriteFile(output.GetTemporaryName(), "text");
    output.Commit();
  }
  reader.join();
  EXPECT_EQ(read, "text");
  EXPECT_EQ(this->ListFiles(), std::set<std::string>{ "pipe" });
}

TEST_F(AtomicOutputTest, TheLongestNameIsNoLonger)
{
  const std::string longest(255, 'x');
  AtomicOutput output(this->GetPath(longest));
  output.Commit();
  EXPECT_EQ(this->ListFiles(), std::set<std::string>{ longest });
  EXPECT_THROW(AtomicOutput(this->GetPath(longest + "x")), WorkError);
}

namespace
{

/// What ends a process.
struct End
{
  const char* Name;
  std::function<void()> Make;
  int Status;
};

std::vector<End> ListEnds()
{
  const auto raising = [](int signal) { return [signal] { raise(signal); }; };
  return {
    { "SIGHUP", raising(SIGHUP), 128 + SIGHUP },
    { "SIGINT", raising(SIGINT), 128 + SIGINT },
    { "SIGQUIT", raising(SIGQUIT), 128 + SIGQUIT },
    { "SIGTERM", raising(SIGTERM), 128 + SIGTERM },
    { "SIGTERM to the supervisor",
      []
      {
        kill(getppid(), SIGTERM);
        pause();
      },
      128 + SIGTERM },
    { "SIGINT on another thread", [] { std::thread([] { raise(SIGINT); }).join(); }, 128 + SIGINT },
    { "SIGSEGV", raising(SIGSEGV), 1 },
    { "SIGABRT", [] { std::abort(); }, 1 },
    { "SIGKILL", raising(SIGKILL), 1 },
    { "SIGXCPU", raising(SIGXCPU), 1 },
    { "exit", [] { std::exit(0); }, 1 },
    { "_exit", [] { _exit(0); }, 1 },
    { "SIGPIPE", raising(SIGPIPE), NotEnded },
    { "SIGXFSZ", raising(SIGXFSZ), NotEnded },
    { "its own end", [] {}, NotEnded },
  };
}

} // namespace

TEST_F(AtomicOutputTest, WhateverEndsTheProcessLeavesNothing)
{
  for (const End& end : ListEnds())
  {
    const int status = RunInChild(
      [&]
      {
        AtomicOutput kept(this->GetPath("kept.txt"));
        WriteFile(kept.GetTemporaryName(), "whole");
        std::list<AtomicOutput> outputs;
        for (int i = 0; i < 70; ++i) // more than are without a name
        {
          outputs.emplace_back(this->GetPath("file-" + std::to_string(i)));
        }
        outputs.emplace_back(this->GetPath("folder"), Marker);
        FillFolder(outputs.back());
        kept.Commit();
        end.Make();
      });
    EXPECT_EQ(status, end.Status) << end.Name;
    EXPECT_EQ(this->ListFiles(), std::set<std::string>{ "kept.txt" }) << end.Name;
    EXPECT_EQ(ReadFile(this->GetPath("kept.txt")), "whole") << end.Name;
    fs::remove(this->GetPath("kept.txt"));
  }
}

TEST_F(AtomicOutputTest, ASignalThatIsIgnoredStaysSo)
{
  const int status = RunInChild(
    []
    {
      signal(SIGHUP, SIG_IGN); // as by nohup
      kill(getppid(), SIGHUP);
      raise(SIGHUP);
    });
  EXPECT_EQ(status, NotEnded);
}

/// A crash at any moment of the life of an output.
TEST_F(AtomicOutputTest, ASignalMayComeAtAnyMoment)
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

TEST_F(AtomicOutputTest, ACrashOfAReaderNamesItsFile)
{
  for (const End& end : ListEnds())
  {
    if (end.Status == 1)
    {
      const std::string errors = this->GetPath("errors");
      RunInChild(
        [&]
        {
          const Worker::Reading reading("mesh\n.vtk");
          end.Make();
        },
        errors);
      const std::string line = ReadFile(errors);
      EXPECT_EQ(line.find("tetralux: cannot read 'mesh\\n.vtk': "), 0u) << end.Name << ": " << line;
      EXPECT_EQ(line.find('\n') + 1, line.size()) << end.Name;
      fs::remove(errors);
    }
  }
}
