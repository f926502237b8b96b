// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/BenchCsv.h"

#include "CommandLine/OptionValues.h"

namespace
{

std::string Quote(const std::string& text)
{
  std::string quoted = "\"";
  for (const char c : text)
  {
    quoted += c;
    if (c == '"')
    {
      quoted += c; // as RFC 4180 has it
    }
  }
  return quoted + "\"";
}

std::string Format(double value) { return std::isnan(value) ? "" : FormatNumber(value); }

std::string JoinWithBlanks(const std::vector<std::string>& words)
{
  std::string text;
  for (const std::string& word : words)
  {
    text += (text.empty() ? "" : " ") + word;
  }
  return text;
}

std::string MakeLine(const BenchSceneResult& result, const BenchRow& row)
{
  std::string line = result.Name + "," + row.Setting.Method + "," + Quote(row.Setting.Name) + "," +
    Quote(JoinWithBlanks(row.Setting.Assignments));
  if (row.Failure.empty())
  {
    const tetralux::ImageErrors& errors = row.Errors;
    const double values[] = { errors.Maximum, errors.RootMeanSquare, errors.Quantile999,
      errors.ShareAbove1Of255, row.ErrorEstimate, 1e3 * row.BestSeconds, 1e3 * row.MedianSeconds,
      static_cast<double>(row.Frames), 1e3 * row.PrepareSeconds };
    for (const double value : values)
    {
      line += "," + Format(value);
    }
    line += "," + (std::isnan(row.Bytes) ? "" : std::to_string(std::llround(row.Bytes)));
    line += std::string(row.EightBit ? ",8" : ",32") + (row.OnFront ? ",1," : ",0,");
  }
  else
  {
    line += ",,,,,,,,,,,,," + Quote(row.Failure);
  }
  return line;
}

} // namespace

std::string MakeCsv(const std::vector<BenchSceneResult>& results)
{
  std::string text =
    "scene,method,setting,properties,largest_error,rms_error,error_99.9,share_above_1/255,"
    "error_estimate,best_ms,median_ms,frames,prepare_ms,bytes,bits,pareto,failure\r\n";
  for (const BenchSceneResult& result : results)
  {
    for (const BenchRow& row : result.Rows)
    {
      text += MakeLine(result, row) + "\r\n";
    }
  }
  return text;
}
