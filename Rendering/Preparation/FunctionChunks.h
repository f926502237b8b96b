// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_FunctionChunks_h
#define tetralux_FunctionChunks_h

#include "vtkColorTransferFunction.h"
#include "vtkPiecewiseFunction.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <array>
#include <type_traits>
#include <vector>

namespace tetralux
{

/// A function of VTK in parts of few nodes: VTK looks for a scalar from the first node on, at each
/// call, so that evaluating a function at all of its nodes takes the square of their number. Values
/// are those of the whole function, to the last bit.
template <class Function>
class FunctionChunks
{
public:
  static constexpr int NodeSize = std::is_same<Function, vtkColorTransferFunction>::value ? 6 : 4;

  /// logarithmic: whether scalars are interpolated by their logarithms.
  FunctionChunks(Function* function, bool logarithmic)
    : Whole(function)
  {
    using Node = std::array<double, NodeSize>;
    const int size = function->GetSize();
    if (size <= 2 * ChunkSize)
    {
      return;
    }
    std::vector<Node> nodes(size);
    for (int i = 0; i < size; ++i)
    {
      function->GetNodeValue(i, nodes[i].data());
    }
    for (int begin = 0; begin < size; begin += ChunkSize)
    {
      // With a smaller scalar before what the part is asked for, and a larger one behind.
      int first = begin;
      while (first > 0 && nodes[first][0] == nodes[begin][0])
      {
        --first;
      }
      const int end = std::min(begin + ChunkSize, size - 1);
      int last = end;
      while (last + 1 < size && nodes[last][0] == nodes[end][0])
      {
        ++last;
      }
      this->Begins.push_back(nodes[begin][0]);
      this->Parts.push_back(
        MakePart(function, logarithmic, nodes.data() + first, nodes.data() + last + 1));
    }
  }

  /// For one scalar: as GetTable(x, x, 1, values).
  void Evaluate(double x, double* values) const
  {
    Function* part = this->Whole;
    if (!this->Parts.empty() && x >= this->Begins.front())
    {
      const auto next = std::upper_bound(this->Begins.begin(), this->Begins.end(), x);
      part = this->Parts[next - this->Begins.begin() - 1];
    }
    part->GetTable(x, x, 1, values);
  }

private:
  /// Copying a part costs as much as a few evaluations.
  static constexpr int ChunkSize = 32;

  template <class Node>
  static vtkSmartPointer<vtkColorTransferFunction> MakePart(
    vtkColorTransferFunction* whole, bool logarithmic, const Node* begin, const Node* end)
  {
    auto part = vtkSmartPointer<vtkColorTransferFunction>::New();
    part->SetColorSpace(whole->GetColorSpace());
    part->SetHSVWrap(whole->GetHSVWrap());
    part->SetScale(logarithmic ? VTK_CTF_LOG10 : VTK_CTF_LINEAR);
    part->SetClamping(whole->GetClamping());
    part->SetUseAboveRangeColor(whole->GetUseAboveRangeColor());
    part->SetAboveRangeColor(whole->GetAboveRangeColor());
    part->SetAllowDuplicateScalars(1);
    for (const Node* node = begin; node != end; ++node)
    {
      const auto& n = *node;
      part->AddRGBPoint(n[0], n[1], n[2], n[3], n[4], n[5]);
    }
    return part;
  }

  template <class Node>
  static vtkSmartPointer<vtkPiecewiseFunction> MakePart(
    vtkPiecewiseFunction* whole, bool logarithmic, const Node* begin, const Node* end)
  {
    auto part = vtkSmartPointer<vtkPiecewiseFunction>::New();
    part->SetUseLogScale(logarithmic);
    part->SetClamping(whole->GetClamping());
    part->SetAllowDuplicateScalars(1);
    for (const Node* node = begin; node != end; ++node)
    {
      const auto& n = *node;
      part->AddPoint(n[0], n[1], n[2], n[3]);
    }
    return part;
  }

  vtkSmartPointer<Function> Whole;
  std::vector<double> Begins;
  std::vector<vtkSmartPointer<Function>> Parts;
};

} // namespace tetralux

#endif
