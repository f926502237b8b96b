// SPDX-License-Identifier: BSD-3-Clause

// Measures a use of the min/max tree that Wald et al. 2007 name in section 9, beside the ray
// caster, which walks from cell to cell: the largest scalar along each ray, by branch and bound. A
// packet of rays skips a node that its frustum misses, and one without a scalar above the least of
// the packet's present maxima. In a leaf, rays are clipped to cells. Nearer nodes come first, or
// those with a larger scalar. See TreePackets.h.

#include "TreePackets.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Scalars of 0..1 that differ by less agree: RayCastOptions::MaximumError, since they are shown as
/// opacities.
constexpr double ScalarTolerance = 1e-4;

/// A way to find the largest scalars.
struct MaximumWay
{
  const char* Name;
  int Edge;
  Order InOrder;
};

template <int Edge>
Counts FindLargest(Subject& subject, const MaximumWay& way, std::vector<float>& picture)
{
  subject.ProjectPoints();
  return ForEachPacket<Edge>(subject,
    [&](Packet<Edge>& packet)
    {
      packet.FindLargest(way.InOrder);
      packet.Write(picture);
    });
}

void CompareMaximum(Subject& subject)
{
  // The opacity is the scalar.
  TransferFunction function;
  const TransferFunction::Value zero = { { 1, 1, 1 }, 0 };
  const TransferFunction::Value one = { { 1, 1, 1 }, 1 };
  function.Nodes = { { 0, zero, zero }, { 1, one, one } };
  subject.Scene.Optics.SetModel(OpticalModel::MaximumIntensity);
  subject.Scene.Optics.SetTransferFunction(function);
  const RayCastStatistics statistics = subject.Cast(Precision::Double);
  std::vector<float> expected;
  for (int i = 0; i < ImageSize * ImageSize; ++i)
  {
    expected.push_back(subject.Colors[4 * i + 3]);
  }

  const MaximumWay ways[] = { { "16 x 16, nearer first", 16, Order::Nearer },
    { "16 x 16, larger first", 16, Order::Larger }, { "8 x 8, nearer first", 8, Order::Nearer },
    { "8 x 8, larger first", 8, Order::Larger } };
  std::vector<float> picture(ImageSize * ImageSize);
  const auto find = [&](const MaximumWay& way)
  {
    return way.Edge == 16 ? FindLargest<16>(subject, way, picture)
                          : FindLargest<8>(subject, way, picture);
  };
  std::vector<std::function<void()>> timed = { [&] { subject.Cast(); } };
  for (const MaximumWay& way : ways)
  {
    timed.emplace_back([&] { find(way); });
  }
  const std::vector<Times> times = MeasureByTurns(timed);

  std::printf("%-18s %-22s %8.1f %8.1f %7s %7s %7s %8.2f\n", subject.Name.c_str(), "cell to cell",
    times[0].Wall, times[0].Processor, "", "", "", 1e-6 * static_cast<double>(statistics.Segments));
  for (std::size_t i = 0; i < std::size(ways); ++i)
  {
    const Counts counts = find(ways[i]);
    double most = 0;
    int different = 0;
    for (int p = 0; p < ImageSize * ImageSize; ++p)
    {
      const double difference = std::fabs(picture[p] - expected[p]);
      most = std::max(most, difference);
      different += difference > ScalarTolerance;
    }
    std::printf("%-18s %-22s %8.1f %8.1f %7.2f %7.2f %7.2f %8.2f %9.1e %5d\n", "", ways[i].Name,
      times[i + 1].Wall, times[i + 1].Processor, 1e-6 * static_cast<double>(counts.Nodes),
      1e-6 * static_cast<double>(counts.Leaves), 1e-6 * static_cast<double>(counts.Cells),
      1e-6 * static_cast<double>(counts.Hits), most, different);
  }
  std::fflush(stdout);
}

void CompareAll()
{
  std::printf(
    "Largest scalar along each ray: wall and processor ms; millions of nodes tested, leaves\n"
    "visited, cells that rays were clipped to, rays in cells; largest difference of a scalar of\n"
    "0..1 from double precision, and pixels where it is above %g\n\n"
    "%-18s %-22s %8s %8s %7s %7s %7s %8s %9s %5s\n",
    ScalarTolerance, "", "", "wall", "proc.", "nodes", "leaves", "cells", "in cells", "most",
    "above");
  for (const auto& subject : MakeSubjects())
  {
    CompareMaximum(*subject);
  }
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

int main()
{
  try
  {
    tetralux::TETRALUX_ISA::CompareAll();
  }
  catch (const std::exception& e)
  {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return 0;
}
