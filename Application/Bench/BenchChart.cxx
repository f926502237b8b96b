// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/BenchChart.h"

#include "Bench/BenchSettings.h"
#include "CommandLine/OptionValues.h"
#include "vtkHeadlessRenderWindow.h"

#include "vtkAxis.h"
#include "vtkBrush.h"
#include "vtkChartLegend.h"
#include "vtkChartXY.h"
#include "vtkContext2D.h"
#include "vtkContextActor.h"
#include "vtkContextItem.h"
#include "vtkContextScene.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPen.h"
#include "vtkPlotLine.h"
#include "vtkPlotPoints.h"
#include "vtkRenderer.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkTextProperty.h"
#include "vtkWindowToImageFilter.h"

#include <algorithm>
#include <array>

namespace
{

constexpr int ChartWidth = 1200;
constexpr int ChartHeight = 800;
constexpr int PlotWidth = 850; ///< the rest is the legend's
constexpr int FontSize = 20;
constexpr int LegendFontSize = 18;
constexpr float MarkerSize = 16;

/// The least error drawn: a float's rounding.
constexpr double SmallestError = 1e-8;

/// Colours, most of which those who see colours differently tell apart too (Okabe and Ito).
constexpr std::array<std::array<unsigned char, 3>, 12> Colors = { { { 0, 0, 0 }, { 0, 114, 178 },
  { 213, 94, 0 }, { 0, 158, 115 }, { 204, 121, 167 }, { 86, 180, 233 }, { 230, 159, 0 },
  { 128, 128, 128 }, { 140, 40, 40 }, { 110, 80, 180 }, { 120, 120, 0 }, { 0, 90, 90 } } };

constexpr std::array<int, 4> Markers = { vtkPlotPoints::CIRCLE, vtkPlotPoints::SQUARE,
  vtkPlotPoints::DIAMOND, vtkPlotPoints::CROSS };

struct Point
{
  double X; ///< milliseconds
  double Y; ///< error
  std::string Label;
  bool Named; ///< the label is drawn
};

Point GetPoint(const BenchRow& row)
{
  const bool named = row.OnFront || row.Setting.Name == DefaultSettingName || IsPeer(row.Setting);
  return { 1e3 * row.BestSeconds, std::max(row.Errors.Maximum, SmallestError), row.Setting.Name,
    named };
}

bool IsDrawn(const BenchRow& row)
{
  return row.Failure.empty() && row.Setting.Name != GetReferenceSetting().Name;
}

vtkSmartPointer<vtkTable> MakeTable(const std::vector<Point>& points)
{
  vtkNew<vtkDoubleArray> x;
  x->SetName("time");
  vtkNew<vtkDoubleArray> y;
  y->SetName("error");
  for (const Point& point : points)
  {
    x->InsertNextValue(point.X);
    y->InsertNextValue(point.Y);
  }
  auto table = vtkSmartPointer<vtkTable>::New();
  table->AddColumn(x);
  table->AddColumn(y);
  return table;
}

/// Decades that hold all values, as exponents.
std::array<int, 2> GetDecades(const std::vector<double>& values)
{
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const int begin = static_cast<int>(std::floor(std::log10(*least)));
  return { begin, std::max(begin + 1, static_cast<int>(std::ceil(std::log10(*most)))) };
}

/// Names each decade, and twos and fives too where there are few.
void SetUpAxis(vtkAxis* axis, const std::string& title, const std::vector<double>& values)
{
  const std::array<int, 2> decades = GetDecades(values);
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkStringArray> labels;
  const bool few = decades[1] - decades[0] <= 3;
  for (int decade = decades[0]; decade <= decades[1]; ++decade)
  {
    for (const int factor : { 1, 2, 5 })
    {
      if (factor == 1 || (few && decade < decades[1]))
      {
        const double value = factor * std::pow(10, decade);
        positions->InsertNextValue(std::log10(value)); // as the axis counts
        labels->InsertNextValue(value < 0.01 ? std::to_string(factor) + "e" + std::to_string(decade)
                                             : FormatNumber(value));
      }
    }
  }
  axis->SetTitle(title);
  axis->GetTitleProperties()->SetFontSize(FontSize);
  axis->GetTitleProperties()->BoldOff();
  axis->GetLabelProperties()->SetFontSize(FontSize);
  axis->SetBehavior(vtkAxis::FIXED);
  axis->LogScaleOn();
  axis->SetUnscaledRange(std::pow(10, decades[0]), std::pow(10, decades[1]));
  axis->SetCustomTickPositions(positions, labels);
  axis->GetGridPen()->SetColor(225, 225, 225);
}

/// Writes names beside points of a chart, where no other name is.
class PointNames : public vtkContextItem
{
public:
  static PointNames* New();
  vtkTypeMacro(PointNames, vtkContextItem);

  vtkChartXY* Chart = nullptr;
  std::vector<Point> Points;

  bool Paint(vtkContext2D* painter) override;

private:
  struct Box
  {
    float Left, Bottom, Right, Top;
  };
  std::array<float, 2> Place(const Point& point) const;
};
vtkStandardNewMacro(PointNames);

std::array<float, 2> PointNames::Place(const Point& point) const
{
  const double values[2] = { point.X, point.Y };
  std::array<float, 2> place;
  for (int i = 0; i < 2; ++i)
  {
    vtkAxis* axis = this->Chart->GetAxis(i == 0 ? vtkAxis::BOTTOM : vtkAxis::LEFT);
    const double part =
      (std::log10(values[i]) - axis->GetMinimum()) / (axis->GetMaximum() - axis->GetMinimum());
    place[i] = static_cast<float>(
      axis->GetPosition1()[i] + part * (axis->GetPosition2()[i] - axis->GetPosition1()[i]));
  }
  return place;
}

bool PointNames::Paint(vtkContext2D* painter)
{
  vtkNew<vtkTextProperty> text;
  text->SetFontSize(FontSize);
  text->SetColor(0, 0, 0);
  painter->ApplyTextProp(text);
  constexpr float gap = 4;
  std::vector<Box> taken;
  for (const Point& point : this->Points)
  {
    const std::array<float, 2> place = this->Place(point);
    taken.push_back({ place[0] - MarkerSize / 2, place[1] - MarkerSize / 2,
      place[0] + MarkerSize / 2, place[1] + MarkerSize / 2 });
  }
  vtkAxis* x = this->Chart->GetAxis(vtkAxis::BOTTOM);
  vtkAxis* y = this->Chart->GetAxis(vtkAxis::LEFT);
  const Box plot{ x->GetPosition1()[0], y->GetPosition1()[1], x->GetPosition2()[0],
    y->GetPosition2()[1] };
  const auto isFree = [&](const Box& box)
  {
    return box.Left > plot.Left && box.Bottom > plot.Bottom && box.Right < plot.Right &&
      box.Top < plot.Top &&
      std::none_of(taken.begin(), taken.end(),
        [&box](const Box& other)
        {
          return box.Left < other.Right && other.Left < box.Right && box.Bottom < other.Top &&
            other.Bottom < box.Top;
        });
  };
  for (const Point& point : this->Points)
  {
    if (!point.Named)
    {
      continue;
    }
    const std::array<float, 2> place = this->Place(point);
    float bounds[4]; // x, y, width, height
    painter->ComputeStringBounds(point.Label, bounds);
    // Beside the mark; where that is taken, ever farther above and below.
    const float offset = MarkerSize / 2 + gap;
    const float lefts[] = { place[0] + offset, place[0] - offset - bounds[2],
      place[0] - bounds[2] / 2 };
    std::vector<std::array<float, 2>> corners;
    for (const float lines : { -0.5f, 0.f, -1.f, 1.f, -2.f })
    {
      for (const float left : lefts)
      {
        corners.push_back({ left, place[1] + lines * bounds[3] });
      }
    }
    for (const std::array<float, 2>& corner : corners)
    {
      const Box box{ corner[0], corner[1], corner[0] + bounds[2], corner[1] + bounds[3] };
      if (isFree(box))
      {
        taken.push_back(box);
        painter->DrawString(corner[0], corner[1], point.Label);
        break;
      }
    }
  }
  return true;
}

void AddFront(vtkChartXY* chart, const std::vector<Point>& front)
{
  auto* line = vtkPlotLine::SafeDownCast(chart->AddPlot(vtkChart::LINE));
  line->SetInputData(MakeTable(front), 0, 1);
  line->SetColor(170, 170, 170, 255);
  line->SetWidth(3);
  line->SetLabel("Pareto front");
}

void AddGroup(
  vtkChartXY* chart, const std::string& group, const std::vector<Point>& points, std::size_t index)
{
  auto* plot = vtkPlotPoints::SafeDownCast(chart->AddPlot(vtkChart::POINTS));
  plot->SetInputData(MakeTable(points), 0, 1);
  const auto& color = Colors[index % Colors.size()];
  plot->SetColor(color[0], color[1], color[2], 255);
  plot->SetMarkerStyle(Markers[(index + index / Colors.size()) % Markers.size()]);
  plot->SetMarkerSize(MarkerSize);
  plot->SetLabel(group);
}

vtkSmartPointer<vtkImageData> Paint(vtkContextItem* item)
{
  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(item);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  renderer->AddActor(actor);
  actor->GetScene()->SetRenderer(renderer);
  vtkNew<vtkHeadlessRenderWindow> window;
  window->SetSize(ChartWidth, ChartHeight);
  window->SetMultiSamples(8);
  window->AddRenderer(renderer);
  window->Render();
  vtkNew<vtkWindowToImageFilter> reader;
  reader->SetInput(window);
  reader->ShouldRerenderOff();
  reader->ReadFrontBufferOff();
  reader->Update();
  return reader->GetOutput();
}

} // namespace

vtkSmartPointer<vtkImageData> DrawErrorChart(const BenchSceneResult& result)
{
  std::vector<double> times;
  std::vector<double> errors;
  std::vector<std::string> groups; // the default's last, so that it is on top
  std::vector<Point> points;
  std::vector<Point> front;
  for (const BenchRow& row : result.Rows)
  {
    if (!IsDrawn(row))
    {
      continue;
    }
    points.push_back(GetPoint(row));
    times.push_back(points.back().X);
    errors.push_back(points.back().Y);
    if (row.OnFront)
    {
      front.push_back(points.back());
    }
    if (std::find(groups.begin(), groups.end(), row.Setting.Group) == groups.end())
    {
      const bool isDefault = row.Setting.Name == DefaultSettingName;
      groups.insert(
        isDefault || groups.empty() ? groups.end() : groups.end() - 1, row.Setting.Group);
    }
  }
  std::sort(front.begin(), front.end(), [](const Point& a, const Point& b) { return a.X < b.X; });

  vtkNew<vtkChartXY> chart;
  chart->SetTitle("Largest error against time of a frame: " + result.Name);
  chart->GetTitleProperties()->SetFontSize(FontSize + 4);
  SetUpAxis(chart->GetAxis(vtkAxis::BOTTOM), "time of a frame, milliseconds, best", times);
  SetUpAxis(
    chart->GetAxis(vtkAxis::LEFT), "largest error of a channel, 0..1; 1e-8: that or less", errors);
  AddFront(chart, front);
  for (std::size_t i = 0; i < groups.size(); ++i)
  {
    std::vector<Point> members;
    for (const BenchRow& row : result.Rows)
    {
      if (IsDrawn(row) && row.Setting.Group == groups[i])
      {
        members.push_back(GetPoint(row));
      }
    }
    AddGroup(chart, groups[i], members, (i + 1) % groups.size()); // the default's is the first
  }
  chart->SetAutoSize(false);
  chart->SetSize(vtkRectf(0, 0, PlotWidth, ChartHeight));
  chart->SetShowLegend(true);
  chart->GetLegend()->SetLabelSize(LegendFontSize);
  chart->GetLegend()->SetInline(false);
  chart->GetLegend()->SetHorizontalAlignment(vtkChartLegend::CUSTOM);
  chart->GetLegend()->SetVerticalAlignment(vtkChartLegend::CUSTOM);
  chart->GetLegend()->SetPoint(PlotWidth + MarkerSize, ChartHeight / 2);

  vtkNew<PointNames> names;
  names->Chart = chart;
  names->Points = points;
  chart->AddItem(names);
  return Paint(chart);
}
