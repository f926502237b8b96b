// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/BenchPage.h"

#include "Bench/BenchSettings.h"
#include "CommandLine/OptionValues.h"

#include <algorithm>
#include <cstdio>
#include <sstream>

namespace
{

constexpr const char* Style = R"(
:root { color-scheme: light; }
body { font: 16px/1.45 system-ui, sans-serif; margin: 0 auto; max-width: 72rem; padding: 0.5rem 1rem; }
h1 { font-size: 1.6rem; } h2 { font-size: 1.3rem; margin-top: 2.5rem; } h3 { font-size: 1.05rem; }
img { max-width: 100%; height: auto; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: 0.85rem; }
th, td { padding: 0.2rem 0.55rem; text-align: right; border-bottom: 1px solid #ddd; white-space: nowrap; }
th:first-child, td:first-child, td.text { text-align: left; white-space: normal; min-width: 12rem; }
thead th { background: #f3f3f3; }
tr.group th { background: #fafafa; text-align: left; }
tr.front td:first-child { border-left: 4px solid #0072b2; }
tr.front td:first-child b { color: #0072b2; }
td img { width: 48px; vertical-align: middle; background: #000; }
.chart img { min-width: 44rem; }
figure { display: inline-block; margin: 0 1rem 1rem 0; vertical-align: top; max-width: 16rem; }
figcaption, .note { font-size: 0.85rem; color: #444; }
dl { display: grid; grid-template-columns: max-content auto; gap: 0.1rem 1rem; font-size: 0.9rem; }
dt { color: #444; } dd { margin: 0; }
)";

std::string Escape(const std::string& text)
{
  std::string escaped;
  for (const char c : text)
  {
    switch (c)
    {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string Print(const char* format, double value)
{
  if (std::isnan(value))
  {
    return "&ndash;";
  }
  char text[64];
  std::snprintf(text, sizeof(text), format, value);
  return text;
}

std::string PrintError(double error) { return error == 0 ? "0" : Print("%.1e", error); }

std::string PrintMilliseconds(double seconds)
{
  return Print(seconds < 0.01 ? "%.2f" : "%.1f", 1e3 * seconds);
}

std::string PrintMegabytes(double bytes) { return Print("%.1f", bytes / 1e6); }

std::string PrintCell(const std::string& text) { return "<td>" + text + "</td>"; }

void WriteHead(std::ostream& page, const std::vector<std::pair<std::string, std::string>>& machine,
  const std::string& command)
{
  page << "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
          "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
          "<title>Tetralux: error against run time</title>\n<style>"
       << Style << "</style>\n</head>\n<body>\n<h1>Error against run time</h1>\n"
       << "<p>Made by <code>" << Escape(command) << "</code> on</p>\n<dl>\n";
  for (const auto& [label, value] : machine)
  {
    page << "<dt>" << Escape(label) << "</dt><dd>" << Escape(value) << "</dd>\n";
  }
  page << "</dl>\n";
}

void WriteHowToRead(std::ostream& page)
{
  page << R"(<h2>How to read it</h2>
<ul>
<li>The <em>reference</em> of a scene is the closed form in double precision, with rays to their ends.</li>
<li><em>Errors</em> are absolute differences to it, of premultiplied red, green, blue and opacity, 0..1,
over the pixels that either picture covers: the largest, the root of the mean square, what 99.9 % of
the pixels stay within, and the share of pixels above 1/255.</li>
<li>Pictures of rows marked <em>8 bit</em> are read from the frame buffer over black: half of 1/255,
which is 2.0e-3, is rounding. VTK's mappers have no other; neither has a picture that is interpolated
between rays. All other pictures are floating point numbers. The picture of VTK's ray caster lies about
half a pixel above and to the right of all others.</li>
<li><em>Time</em> is that of a whole frame, compositing included, in the same window without
multisampling; the camera counts as moved before each. The first frame is not among those timed:
<em>prepare</em> is what it took longer. VTK's ray caster takes as many threads as it chooses. A
measurement ends early, with fewer frames, when it takes long.</li>
<li><em>Bytes</em> are those of the mapper's tables, where it tells them.</li>
<li><em>Costs</em> and <em>buys</em>: the time relative to the default's, and how many times smaller the
largest error is than the default's.</li>
<li>A blue bar marks the <em>Pareto front</em>: no other row has both a smaller largest error and a shorter
best time.</li>
<li>A <em>difference picture</em> is the largest error of each pixel's channels times the number beside
it; white is 1 or more. Here it is small, each pixel the largest of those that it stands for.</li>
</ul>
)";
}

void WriteSummary(std::ostream& page, const std::vector<BenchSceneResult>& results)
{
  page << "<h2>Scenes</h2>\n<div class=\"scroll\"><table><thead><tr><th>scene</th><th>default, "
          "ms</th><th>largest error</th>";
  std::vector<std::string> peers;
  for (const BenchRow& row : results.front().Rows)
  {
    if (IsPeer(row.Setting))
    {
      peers.push_back(row.Setting.Name);
      page << "<th>" << Escape(row.Setting.Name) << ", ms</th><th>largest error</th>";
    }
  }
  page << "</tr></thead><tbody>\n";
  for (const BenchSceneResult& result : results)
  {
    page << "<tr><td><a href=\"#" << Escape(result.Name) << "\">" << Escape(result.Name)
         << "</a></td>";
    std::vector<std::string> names = { DefaultSettingName };
    names.insert(names.end(), peers.begin(), peers.end());
    for (const std::string& name : names)
    {
      const BenchRow* row = FindRow(result, name);
      page << PrintCell(row ? PrintMilliseconds(row->BestSeconds) : "failed")
           << PrintCell(row ? PrintError(row->Errors.Maximum) : "");
    }
    page << "</tr>\n";
  }
  page << "</tbody></table></div>\n";
}

/// The error that is asked for and the error that is made, scene by scene.
void WriteErrorsAskedFor(std::ostream& page, const std::vector<BenchSceneResult>& results)
{
  std::vector<const BenchRow*> dial;
  for (const BenchRow& row : results.front().Rows)
  {
    if (row.Setting.Group == ErrorDialGroup)
    {
      dial.push_back(&row);
    }
  }
  if (dial.empty())
  {
    return;
  }
  page << "<h2>Error asked for, and largest error made</h2>\n<div class=\"scroll\"><table><thead>"
          "<tr><th>scene</th>";
  for (const BenchRow* row : dial)
  {
    page << "<th>" << Escape(row->Setting.Assignments.front()) << "</th>";
  }
  page << "</tr></thead><tbody>\n";
  for (const BenchSceneResult& result : results)
  {
    page << "<tr>" << PrintCell(Escape(result.Name));
    for (const BenchRow* asked : dial)
    {
      const BenchRow* row = FindRow(result, asked->Setting.Name);
      page << PrintCell(row ? PrintError(row->Errors.Maximum) : "failed");
    }
    page << "</tr>\n";
  }
  page << "</tbody></table></div>\n";
}

void WriteFigure(std::ostream& page, const std::string& uri, const std::string& caption)
{
  page << "<figure><img src=\"" << uri << "\" alt=\"" << Escape(caption) << "\"><figcaption>"
       << Escape(caption) << "</figcaption></figure>\n";
}

/// What a setting costs and buys, measured by the default one.
std::string PrintRelations(const BenchRow& row, const BenchRow* base)
{
  if (!base)
  {
    return PrintCell("") + PrintCell("");
  }
  return PrintCell(Print("%.2f", row.BestSeconds / base->BestSeconds) + " &times;") +
    PrintCell(row.Errors.Maximum > 0
        ? Print("%.2g", base->Errors.Maximum / row.Errors.Maximum) + " &times;"
        : "exact");
}

void WriteRow(std::ostream& page, const BenchRow& row, const BenchRow* base)
{
  std::string title = "<td title=\"";
  for (const std::string& assignment : row.Setting.Assignments)
  {
    title += Escape(assignment) + " ";
  }
  title += "\"><b>" + Escape(row.Setting.Name) + "</b><br><span class=\"note\">" +
    Escape(row.Setting.Description) + "</span></td>";
  page << (row.OnFront ? "<tr class=\"front\">" : "<tr>") << title;
  if (!row.Failure.empty())
  {
    page << "<td class=\"text\" colspan=\"12\">failed: " << Escape(row.Failure) << "</td></tr>\n";
    return;
  }
  const tetralux::ImageErrors& errors = row.Errors;
  page << PrintCell(PrintMilliseconds(row.BestSeconds))
       << PrintCell(PrintMilliseconds(row.MedianSeconds)) << PrintCell(std::to_string(row.Frames))
       << PrintCell(PrintError(errors.Maximum)) << PrintCell(PrintError(errors.RootMeanSquare))
       << PrintCell(PrintError(errors.Quantile999))
       << PrintCell(Print("%.2f %%", 100 * errors.ShareAbove1Of255))
       << PrintCell(std::isnan(row.ErrorEstimate) ? "&ndash;" : PrintError(row.ErrorEstimate))
       << PrintRelations(row, base) << PrintCell(PrintMilliseconds(row.PrepareSeconds))
       << PrintCell(PrintMegabytes(row.Bytes));
  if (row.DifferenceFile.empty())
  {
    page << PrintCell("") << "</tr>\n";
    return;
  }
  page << "<td><img src=\"" << row.DifferenceUri << "\" alt=\"difference of "
       << Escape(row.Setting.Name) << "\"> <span class=\"note\">&times; "
       << FormatNumber(row.Amplification) << (row.EightBit ? ", 8 bit" : "")
       << "</span></td></tr>\n";
}

void WriteFiles(std::ostream& page, const BenchSceneResult& result)
{
  page << "<details><summary>Files of this scene, beside the page</summary><p class=\"note\">"
       << Escape(result.ChartFile);
  for (const BenchRow& row : result.Rows)
  {
    for (const std::string& file : { row.PictureFile, row.DifferenceFile })
    {
      page << (file.empty() ? "" : "<br>") << Escape(file);
    }
  }
  page << "</p></details>\n";
}

void WriteTable(std::ostream& page, const BenchSceneResult& result)
{
  page
    << "<div class=\"scroll\"><table><thead><tr><th>setting</th><th>best, ms</th><th>median, "
       "ms</th><th>frames</th><th>largest error</th><th>RMS</th><th>99.9 %</th><th>above "
       "1/255</th><th>own estimate</th><th>costs</th><th>buys</th><th>prepare, ms</th><th>MB</th>"
       "<th>difference</th></tr></thead><tbody>\n";
  const BenchRow* base = FindRow(result, DefaultSettingName);
  std::string group;
  for (const BenchRow& row : result.Rows)
  {
    if (row.Setting.Group != group)
    {
      group = row.Setting.Group;
      page << "<tr class=\"group\"><th colspan=\"14\">" << Escape(group) << "</th></tr>\n";
    }
    WriteRow(page, row, base);
  }
  page << "</tbody></table></div>\n";
}

void WriteScene(std::ostream& page, const BenchSceneResult& result)
{
  page << "<h2 id=\"" << Escape(result.Name) << "\">" << Escape(result.Name) << "</h2>\n<p>"
       << Escape(result.Description) << "; " << result.Width << " x " << result.Height
       << " pixels.</p>\n<div class=\"scroll chart\"><img src=\"" << result.ChartUri
       << "\" alt=\"largest error against time of a frame\"></div>\n";
  for (const BenchRow& row : result.Rows)
  {
    if (!row.PictureUri.empty())
    {
      WriteFigure(page, row.PictureUri, row.Setting.Name);
    }
  }
  WriteTable(page, result);
  WriteFiles(page, result);
}

void WriteFeatures(std::ostream& page, const std::vector<BenchFeature>& features)
{
  page << R"(<h2 id="features">What features cost, and do not cost unused</h2>
<p>Best frames, measured in turns. <em>Without</em>: what runs where a scene does not use a feature,
and what the mapper says it left out.
<em>Forced</em>: the same picture, but the general code for the feature runs, since the scene seems to
use it: what an unused feature would cost if it were not left out; beside it the largest difference of
that picture. <em>Used</em>: the feature changes the picture, and with it how much there is to do.</p>
<div class="scroll"><table><thead><tr><th>feature</th><th>without</th><th>ms</th><th>forced</th><th>ms</th>
<th>ratio</th><th>difference</th><th>used</th><th>ms</th><th>ratio</th></tr></thead><tbody>
)";
  for (const BenchFeature& feature : features)
  {
    const bool forced = !feature.Forced.empty();
    page << "<tr>" << PrintCell(Escape(feature.Name)) << "<td class=\"text\">"
         << Escape(feature.Plain)
         << (feature.LeftOut.empty()
                ? ""
                : "<br><span class=\"note\">left out: " + Escape(feature.LeftOut) + "</span>")
         << "</td>" << PrintCell(PrintMilliseconds(feature.PlainSeconds)) << "<td class=\"text\">"
         << (forced ? Escape(feature.Forced) : "cannot be had") << "</td>"
         << PrintCell(PrintMilliseconds(feature.ForcedSeconds))
         << PrintCell(Print("%.2f", feature.ForcedSeconds / feature.PlainSeconds))
         << PrintCell(forced ? PrintError(feature.ForcedDifference) : "&ndash;")
         << "<td class=\"text\">" << Escape(feature.Used) << "</td>"
         << PrintCell(PrintMilliseconds(feature.UsedSeconds))
         << PrintCell(Print("%.2f", feature.UsedSeconds / feature.PlainSeconds)) << "</tr>\n";
  }
  page << "</tbody></table></div>\n";
}

} // namespace

std::string MakePage(const std::vector<BenchSceneResult>& results,
  const std::vector<BenchFeature>& features,
  const std::vector<std::pair<std::string, std::string>>& machine, const std::string& command)
{
  std::ostringstream page;
  WriteHead(page, machine, command);
  WriteHowToRead(page);
  WriteSummary(page, results);
  WriteErrorsAskedFor(page, results);
  for (const BenchSceneResult& result : results)
  {
    WriteScene(page, result);
  }
  if (!features.empty())
  {
    WriteFeatures(page, features);
  }
  page << "</body>\n</html>\n";
  return page.str();
}
