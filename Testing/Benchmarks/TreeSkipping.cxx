// SPDX-License-Identifier: BSD-3-Clause

// Measures a use of the min/max tree that Wald et al. 2007 name in section 9, beside the ray
// caster: transfer functions that show a part of the scalars' range. What the ray caster takes
// today, and what it takes at least to find the visible cells along the rays by the tree. See
// TreePackets.h.

#include "TreePackets.h"

#include "Scene/VisibleCells.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// The function that shows the scalars of an interval around the middle of their range.
TransferFunction MakeWindow(double share, double radius)
{
  const TransferFunction::Value nothing = { { 0, 0, 0 }, 0 };
  const TransferFunction::Value low = { { 1, 0.5, 0 }, 1 / radius };
  const TransferFunction::Value high = { { 0, 0.5, 1 }, 1 / radius };
  TransferFunction function;
  function.Nodes = { { 0.5 - 0.5 * share, nothing, low }, { 0.5 + 0.5 * share, high, nothing } };
  return function;
}

/// Tells nodes without visible scalars.
class HiddenNodes
{
public:
  HiddenNodes(const Subject& subject, double share)
    : Ranges(subject.Ranges.Nodes)
    , Least(subject.Ranges.GetStep(0.5 - 0.5 * share))
    , Most(subject.Ranges.GetStep(0.5 + 0.5 * share))
  {
  }

  TETRALUX_INLINE bool operator()(std::int32_t id) const
  {
    const MinMaxTree::Range range = this->Ranges[id];
    return range.Largest < this->Least || range.Least > this->Most;
  }

private:
  const std::vector<MinMaxTree::Range>& Ranges;
  std::int32_t Least, Most;
};

/// Finds the leaves with visible scalars along the rays.
template <int Edge>
Counts FindLeaves(const Subject& subject, double share)
{
  const HiddenNodes hidden(subject, share);
  return ForEachPacket<Edge>(subject,
    [&](Packet<Edge>& packet)
    { packet.Walk(Order::Nearer, hidden, [](const MinMaxTree::Node&) {}); });
}

/// Calls function as Packet::ClipTo where rays of 16 x 16 go through visible cells. begin(): is
/// called before each packet.
template <class Begin, class Function>
Counts ClipToVisible(const Subject& subject, double share, const std::vector<std::uint8_t>& visible,
  const Begin& begin, const Function& function)
{
  const HiddenNodes hidden(subject, share);
  return ForEachPacket<16>(subject,
    [&](Packet<16>& packet)
    {
      begin();
      packet.Walk(Order::Nearer, hidden,
        [&](const MinMaxTree::Node& node)
        {
          for (std::int32_t i = node.First; i < node.First + node.Count; ++i)
          {
            if (visible[subject.Tree.Cells[i]])
            {
              packet.ClipTo(
                i, [](int) { return false; }, function);
            }
          }
        });
    });
}

/// What is to be integrated of a cell.
struct Segment
{
  float Near, Far; ///< keys
  float NearScalar, FarScalar;
};

/// The segments of the rays of a packet, front to back.
class alignas(64) SegmentLists
{
public:
  void Clear()
  {
    for (std::vector<Segment>& list : this->Lists)
    {
      list.clear();
    }
  }

  /// Few segments are nearer than one that was there before, since leaves come front to back.
  void Insert(int ray, const Segment& segment)
  {
    std::vector<Segment>& list = this->Lists[ray];
    list.push_back(segment);
    std::size_t i = list.size() - 1;
    for (; i > 0 && list[i - 1].Near < segment.Near; --i)
    {
      list[i] = list[i - 1];
    }
    list[i] = segment;
  }

private:
  std::vector<Segment> Lists[16 * 16];
};

/// Makes the segments of all rays, packet by packet.
void SortSegments(const Subject& subject, double share, const std::vector<std::uint8_t>& visible,
  std::vector<SegmentLists>& lists)
{
  ClipToVisible(
    subject, share, visible, [&] { lists[omp_get_thread_num()].Clear(); },
    [&](int chunk, Float8 u, Float8 v, Float8 far, Float8 near, Mask8 hits, const PlacedCell& cell)
    {
      float values[4][LaneCount];
      Store(values[0], cell.GetKey(near));
      Store(values[1], cell.GetKey(far));
      Store(values[2], cell.GetScalar(u, v, near));
      Store(values[3], cell.GetScalar(u, v, far));
      SegmentLists& own = lists[omp_get_thread_num()];
      for (unsigned bits = Bits(hits); bits != 0; bits &= bits - 1)
      {
        const int i = __builtin_ctz(bits);
        own.Insert(
          chunk * LaneCount + i, { values[0][i], values[1][i], values[2][i], values[3][i] });
      }
    });
}

void MeasureSkipping(Subject& subject)
{
  std::vector<SegmentLists> lists(Threads);
  for (const double share : { 1., 0.6, 0.2, 0.05 })
  {
    const TransferFunction function = MakeWindow(share, subject.Walk->GetRadius());
    const std::vector<std::uint8_t> visible =
      FindVisibleCells(function, subject.Walk->GetMesh().Cells, subject.Scalars, false);
    subject.Scene.Optics.SetModel(OpticalModel::EmissionAbsorption);
    RayCastStatistics statistics;
    Counts clipped;
    const std::vector<Times> times = MeasureByTurns({ [&]
      {
        subject.Scene.Optics.SetTransferFunction(function); // a new version: all is made anew
        statistics = subject.Cast();
      },
      [&] { subject.Cast(); }, [&] { FindLeaves<16>(subject, share); },
      [&] { FindLeaves<8>(subject, share); },
      [&]
      {
        subject.ProjectPoints();
        clipped = ClipToVisible(
          subject, share, visible, [] {},
          [](int, Float8, Float8, Float8, Float8, Mask8, const PlacedCell&) {});
      },
      [&]
      {
        subject.ProjectPoints();
        SortSegments(subject, share, visible, lists);
      } });
    const auto segments = static_cast<double>(statistics.Segments);
    const auto hits = static_cast<double>(clipped.Hits);
    const double part = 100. * static_cast<double>(std::count(visible.begin(), visible.end(), 1)) /
      static_cast<double>(visible.size());
    std::printf(
      "%-20s %5.0f %6.1f %6s %8.1f %8.1f %8.2f %8.2f %8.1f %8.2f %8.1f %8.1f %8.1f %8.1f\n",
      share == 1 ? subject.Name.c_str() : "", 100 * share, part,
      statistics.TransparentCells > 0 ? "yes" : "no", times[0].Processor, times[1].Processor,
      1e-6 * static_cast<double>(statistics.Paths), 1e-6 * segments,
      100 * std::max(0., segments - hits) / segments, 1e-6 * hits, times[2].Processor,
      times[3].Processor, times[4].Processor, times[5].Processor);
    std::fflush(stdout);
  }
}

void MeasureAll()
{
  std::printf(
    "A part of the range is visible: %% of the range, %% of the cells; whether the ray\n"
    "caster leaves the others out; its first frame of a function, and those after, processor ms;\n"
    "millions of entries and of cells walked through, %% of these that are transparent;\n"
    "millions of visible cells that rays go through; ms of finding the visible leaves\n"
    "by packets of 16 x 16 and of 8 x 8, of clipping rays to\ntheir cells, too (16 x 16), and of "
    "keeping what was clipped in order along each ray, too\n\n"
    "%-20s %5s %6s %6s %8s %8s %8s %8s %8s %8s %8s %8s %8s %8s\n",
    "", "range", "cells", "left", "first", "after", "entries", "walked", "transp.", "visible",
    "leaves16", "leaves8", "clip", "order");
  for (const auto& subject : MakeSubjects())
  {
    MeasureSkipping(*subject);
  }
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

int main()
{
  try
  {
    tetralux::TETRALUX_ISA::MeasureAll();
  }
  catch (const std::exception& e)
  {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return 0;
}
