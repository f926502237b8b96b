// SPDX-License-Identifier: BSD-3-Clause
#include "Compositing/OrderedPictures.h"

#include "vtkMultiProcessController.h"

#include <algorithm>
#include <cmath>

namespace tetralux
{

namespace
{

/// What a process tells the others of its picture.
struct Notice
{
  double X, Y, Width, Height; ///< of the rectangle
  double OriginX, OriginY;
};
constexpr int NoticeSize = sizeof(Notice) / sizeof(double);

/// The picture of a process, where it is in the frame buffer of the one that shows the whole.
struct PlacedPicture
{
  PixelRectangle Rectangle;
  const float* Colors;
};

PixelRectangle Unite(const std::vector<PlacedPicture>& pictures)
{
  PixelRectangle united;
  for (const PlacedPicture& picture : pictures)
  {
    const PixelRectangle& rectangle = picture.Rectangle;
    if (rectangle.Width == 0)
    {
      continue;
    }
    if (united.Width == 0)
    {
      united = rectangle;
      continue;
    }
    const int right = std::max(united.X + united.Width, rectangle.X + rectangle.Width);
    const int top = std::max(united.Y + united.Height, rectangle.Y + rectangle.Height);
    united.X = std::min(united.X, rectangle.X);
    united.Y = std::min(united.Y, rectangle.Y);
    united.Width = right - united.X;
    united.Height = top - united.Y;
  }
  return united;
}

/// Front to back; pictures are in that order.
void CompositeRow(
  const std::vector<PlacedPicture>& pictures, const PixelRectangle& whole, int row, float* colors)
{
  for (int column = 0; column < whole.Width; ++column)
  {
    float* sum = colors + 4 * static_cast<std::size_t>(column);
    for (const PlacedPicture& picture : pictures)
    {
      const PixelRectangle& rectangle = picture.Rectangle;
      const int x = whole.X + column - rectangle.X;
      const int y = whole.Y + row - rectangle.Y;
      if (x < 0 || y < 0 || x >= rectangle.Width || y >= rectangle.Height)
      {
        continue;
      }
      const float* added = picture.Colors + 4 * (static_cast<std::size_t>(y) * rectangle.Width + x);
      const float transmittance = 1 - sum[3];
      for (int channel = 0; channel < 3; ++channel)
      {
        sum[channel] += transmittance * added[channel];
      }
      sum[3] += transmittance * std::abs(added[3]);
      if (std::signbit(added[3]))
      {
        break;
      }
    }
  }
}

} // namespace

OrderedPictures CompositePictures(vtkMultiProcessController* controller,
  const std::vector<int>& order, int shower, const PartialPicture& mine,
  const std::array<double, 2>& origin)
{
  const int processes = controller->GetNumberOfProcesses();
  const PixelRectangle& rectangle = mine.Rectangle;
  const Notice notice = { static_cast<double>(rectangle.X), static_cast<double>(rectangle.Y),
    static_cast<double>(rectangle.Width), static_cast<double>(rectangle.Height), origin[0],
    origin[1] };
  std::vector<Notice> notices(processes);
  controller->AllGather(&notice.X, &notices.front().X, NoticeSize);

  OrderedPictures result;
  result.Bytes = sizeof(Notice) * processes * (processes - 1);
  std::vector<vtkIdType> lengths, offsets;
  vtkIdType total = 0;
  for (int process = 0; process < processes; ++process)
  {
    lengths.push_back(4 * static_cast<vtkIdType>(notices[process].Width * notices[process].Height));
    offsets.push_back(total);
    total += lengths.back();
    result.Bytes += process == shower ? 0 : sizeof(float) * lengths.back();
  }
  const bool shows = controller->GetLocalProcessId() == shower;
  std::vector<float> colors(shows ? total : 0);
  controller->GatherV(mine.Colors.data(), colors.data(), static_cast<vtkIdType>(mine.Colors.size()),
    lengths.data(), offsets.data(), shower);
  if (!shows)
  {
    return result;
  }

  std::vector<PlacedPicture> pictures;
  for (const int process : order)
  {
    const Notice& of = notices[process];
    const double x = of.X + std::round(of.OriginX - notices[shower].OriginX);
    const double y = of.Y + std::round(of.OriginY - notices[shower].OriginY);
    pictures.push_back({ { static_cast<int>(x), static_cast<int>(y), static_cast<int>(of.Width),
                           static_cast<int>(of.Height) },
      colors.data() + offsets[process] });
  }
  PartialPicture& whole = result.Whole;
  whole.Rectangle = Unite(pictures);
  const std::size_t rowSize = static_cast<std::size_t>(4) * whole.Rectangle.Width;
  whole.Colors.assign(rowSize * whole.Rectangle.Height, 0.f);
#pragma omp parallel for
  for (int row = 0; row < whole.Rectangle.Height; ++row)
  {
    CompositeRow(pictures, whole.Rectangle, row, whole.Colors.data() + row * rowSize);
  }
  return result;
}

} // namespace tetralux
