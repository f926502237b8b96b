// SPDX-License-Identifier: BSD-3-Clause
// What becomes of results: the Pareto front, JSON, CSV and the page, from results made by hand.

#include "Bench/BenchCsv.h"
#include "Bench/BenchFront.h"
#include "Bench/BenchJson.h"
#include "Bench/BenchPage.h"
#include "Bench/BenchResults.h"
#include "Bench/BenchSettings.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace
{

BenchRow MakeRow(const std::string& name, double error, double seconds)
{
  BenchRow row;
  row.Setting.Name = name;
  row.Errors.Maximum = error;
  row.BestSeconds = seconds;
  return row;
}

/// Names of the rows on the front, with a comma behind each.
std::string FindFront(const std::vector<BenchRow>& rows)
{
  BenchSceneResult result;
  result.Rows = rows;
  MarkFront(result);
  std::string names;
  for (const BenchRow& row : result.Rows)
  {
    names += row.OnFront ? row.Setting.Name + "," : "";
  }
  return names;
}

BenchSceneResult MakeScene()
{
  BenchSceneResult scene;
  scene.Name = "ball";
  scene.Description = "a \"ball\", </script>";
  BenchRow row = MakeRow("one, \"two\"", 0.125, 0.25);
  row.Setting.Assignments = { "A=1", "B=2" };
  row.MedianSeconds = 0.5;
  row.PrepareSeconds = 0.75;
  row.Frames = 3;
  row.Bytes = 3e9;
  row.OnFront = true;
  row.PictureFile = "a.png";
  row.DifferenceFile = "b.png";
  row.DifferenceUri = "data:b";
  scene.Rows.push_back(row);
  BenchRow failed = MakeRow("failed", 0, 0);
  failed.Failure = "no memory";
  scene.Rows.push_back(failed);
  return scene;
}

nlohmann::ordered_json MakeJson()
{
  BenchFeature feature = { "shading", "flat", "", "shaded", "", 0.5, NoNumber, 1, NoNumber };
  return MakeResults({ MakeScene() }, { feature }, { { "Cores", "2" } }, "tetralux bench");
}

} // namespace

TEST(BenchFront, HasWhatNoOtherRowBeats)
{
  EXPECT_EQ(FindFront({ MakeRow("fast", 1, 1), MakeRow("middle", 0.5, 2), MakeRow("slow", 0.1, 9),
              MakeRow("beaten by middle", 0.6, 3), MakeRow("beaten by all", 2, 10) }),
    "fast,middle,slow,");
}

TEST(BenchFront, NeedsToBeBetterInOneOnly)
{
  EXPECT_EQ(FindFront({ MakeRow("a", 1, 1), MakeRow("slower", 1, 2) }), "a,");
  EXPECT_EQ(FindFront({ MakeRow("less exact", 2, 1), MakeRow("a", 1, 1) }), "a,");
}

TEST(BenchFront, HasBothOfTwoEqualRows)
{
  EXPECT_EQ(FindFront({ MakeRow("a", 1, 1), MakeRow("b", 1, 1) }), "a,b,");
}

TEST(BenchFront, IgnoresTheReferenceAndFailures)
{
  BenchRow failed = MakeRow("failed", 0, 0);
  failed.Failure = "no memory";
  EXPECT_EQ(FindFront({ MakeRow(ReferenceSettingName, 0, 0), failed, MakeRow("a", 1, 1) }), "a,");
}

TEST(BenchJson, HasMillisecondsAndNullForWhatThereIsNot)
{
  const nlohmann::ordered_json json = MakeJson();
  EXPECT_EQ(json.at("machine").at("Cores"), "2");
  const nlohmann::ordered_json& row = json.at("scenes").at(0).at("settings").at(0);
  EXPECT_EQ(row.at("properties"), "A=1 B=2");
  EXPECT_EQ(row.at("best_ms"), 250);
  EXPECT_EQ(row.at("median_ms"), 500);
  EXPECT_EQ(row.at("prepare_ms"), 750);
  EXPECT_EQ(row.at("bytes").dump(), "3000000000");
  EXPECT_EQ(row.at("error_estimate").dump(), "null");
  EXPECT_EQ(row.at("pareto"), true);
  const nlohmann::ordered_json& failed = json.at("scenes").at(0).at("settings").at(1);
  EXPECT_EQ(failed.at("failure"), "no memory");
  EXPECT_FALSE(failed.contains("best_ms"));
  EXPECT_TRUE(json.at("features").at(0).at("forced").is_null());
  EXPECT_EQ(json.at("features").at(0).at("used").at("best_ms"), 1000);
}

TEST(BenchCsv, QuotesTextAndLeavesOutWhatThereIsNot)
{
  EXPECT_EQ(MakeCsv(MakeJson()),
    "scene,method,setting,properties,largest_error,rms_error,error_99.9,share_above_1/255,"
    "error_estimate,best_ms,median_ms,frames,prepare_ms,bytes,bits,pareto,failure\r\n"
    "\"ball\",\"ray-cast\",\"one, \"\"two\"\"\",\"A=1 B=2\",0.125,0,0,0,,250,500,3,750,3000000000,"
    "32,1,\r\n"
    "\"ball\",\"ray-cast\",\"failed\",\"\",,,,,,,,,,,,,\"no memory\"\r\n");
}

TEST(BenchPage, HasTheResultsAndTheSmallPictures)
{
  const std::string page = MakePage(MakeJson(), { MakeScene() });
  const std::string start = "<script id=\"results\" type=\"application/json\">";
  const std::size_t begin = page.find(start) + start.size();
  ASSERT_GT(begin, start.size());
  // A description with the end of a script does not end this one.
  const std::string text = page.substr(begin, page.find("</script>", begin) - begin);
  nlohmann::ordered_json expected = MakeJson();
  expected["images"]["b.png"] = "data:b";
  EXPECT_EQ(nlohmann::ordered_json::parse(text).dump(),
    nlohmann::ordered_json::parse(expected.dump()).dump());
}
