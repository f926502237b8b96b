// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/BenchMeasure.h"

#include "Bench/BenchMappers.h"
#include "Bench/BenchPictures.h"
#include "Bench/BenchScene.h"
#include "Bench/BenchSettings.h"
#include "CommandLine/CommandErrors.h"
#include "Files/AtomicOutput.h"
#include "Files/WriteData.h"
#include "Setup/SceneOptions.h"

#include "vtkAbstractVolumeMapper.h"
#include "vtkImageData.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace
{

/// Edges of the pictures of the page, in pixels.
constexpr int ReferenceSize = 256;
constexpr int PeerSize = 128;
constexpr int DifferenceSize = 64;

/// Returns whether a member of the statistics is the size of a table.
bool IsBytes(const std::string& name) { return name == "bytes" || name == "table_bytes"; }

/// Returns the sum of the sizes of all tables, at any depth; not a number if there are none.
double SumBytes(const nlohmann::json& statistics)
{
  double sum = NoNumber;
  for (const auto& [name, value] : statistics.items())
  {
    const double bytes = value.is_object() ? SumBytes(value)
      : IsBytes(name)                      ? value.get<double>()
                                           : NoNumber;
    if (!std::isnan(bytes))
    {
      sum = bytes + (std::isnan(sum) ? 0 : sum);
    }
  }
  return sum;
}

double GetMedian(std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void TimeFrames(const BenchRun& run, BenchView& view, BenchRow& row)
{
  const double first = view.Render();
  std::vector<double> seconds;
  double total = 0;
  while (static_cast<int>(seconds.size()) < run.Frames &&
    (static_cast<int>(seconds.size()) < FewestFrames || total < LongestMeasurement))
  {
    seconds.push_back(view.Render());
    total += seconds.back();
  }
  row.Frames = static_cast<int>(seconds.size());
  row.BestSeconds = *std::min_element(seconds.begin(), seconds.end());
  row.MedianSeconds = GetMedian(seconds);
  row.PrepareSeconds = std::max(0.0, first - row.MedianSeconds);
}

} // namespace

BenchMeasurement Measure(const BenchRun& run, const BenchSetting& setting)
{
  BenchMeasurement measurement;
  BenchRow& row = measurement.Row;
  row.Setting = setting;
  try
  {
    BenchView view(
      run.Window, run.Scene, MakeBenchMapper(setting, run.View.NumberOfThreads), run.View);
    TimeFrames(run, view, row);
    row.EightBit = !HasFloatPicture(setting);
    measurement.Picture = row.EightBit ? view.CaptureWindow() : view.GetFloatPicture();
    const auto statistics = nlohmann::json::parse(view.GetStatistics());
    row.Bytes = SumBytes(statistics);
    if (statistics.contains("error"))
    {
      row.ErrorEstimate = statistics["error"].value("estimate", NoNumber);
    }
  }
  catch (const WorkError& error)
  {
    row.Failure = error.what();
  }
  return measurement;
}

void Compare(const BenchRun& run, const BenchPicture& reference, BenchMeasurement& measurement)
{
  BenchRow& row = measurement.Row;
  const BenchPicture& picture = measurement.Picture;
  row.Errors = MeasureErrors(picture, reference);
  row.Amplification = ChooseAmplification(row.Errors);
  const std::string stem = "pictures/" + run.Scene.Name + "-" + row.Setting.Name;

  const vtkSmartPointer<vtkImageData> image = MakeImage(picture);
  row.PictureFile = stem + ".png";
  WritePng(image, run.Folder.AddFile(row.PictureFile), row.PictureFile);
  const bool isReference = row.Setting.Name == ReferenceSettingName;
  if (isReference || IsPeer(row.Setting))
  {
    row.PictureUri = MakePngUri(ShrinkToMean(image, isReference ? ReferenceSize : PeerSize));
  }
  if (!isReference)
  {
    const vtkSmartPointer<vtkImageData> difference =
      MakeDifferenceImage(picture, reference, row.Amplification);
    row.DifferenceFile = stem + "-difference.png";
    WritePng(difference, run.Folder.AddFile(row.DifferenceFile), row.DifferenceFile);
    row.DifferenceUri = MakePngUri(ShrinkToMaximum(difference, DifferenceSize));
  }
}
