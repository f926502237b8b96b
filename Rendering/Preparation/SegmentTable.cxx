// SPDX-License-Identifier: BSD-3-Clause
#include "Preparation/SegmentTable.h"

#include "PreIntegration/PreIntegrationBuilder.h"
#include "PreIntegration/PreIntegrationError.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <utility>

namespace tetralux
{
namespace
{

/// A table for the time of an interaction: built in a few milliseconds.
constexpr std::size_t CoarseBytes = std::size_t{ 1 } << 20;

/// A few milliseconds for the estimate, too.
constexpr std::size_t RaysForCoarse = 64;

/// The first rays of a sample, which are as random as all of them.
RaySample TakeFew(const RaySample& sample)
{
  const auto end = static_cast<std::ptrdiff_t>(std::min(RaysForCoarse, sample.Rays.size()));
  RaySample few;
  few.Rays.assign(sample.Rays.begin(), sample.Rays.begin() + end);
  return few;
}

bool operator==(const TransferFunction::Value& a, const TransferFunction::Value& b)
{
  return std::equal(a.Color, a.Color + 3, b.Color) && a.Attenuation == b.Attenuation;
}

bool AreEqual(const TransferFunction& a, const TransferFunction& b)
{
  return std::equal(a.Nodes.begin(), a.Nodes.end(), b.Nodes.begin(), b.Nodes.end(),
    [](const TransferFunction::Node& x, const TransferFunction::Node& y)
    { return x.Scalar == y.Scalar && x.Left == y.Left && x.Right == y.Right; });
}

bool AreEqual(const SegmentTable::Request& a, const SegmentTable::Request& b)
{
  const TableGoal& x = a.Goal;
  const TableGoal& y = b.Goal;
  return x.AlwaysTable == y.AlwaysTable && x.MaximumError == y.MaximumError &&
    x.MaximumBytes == y.MaximumBytes && x.LookupCost == y.LookupCost && x.Rays == y.Rays &&
    x.LongestSegment == y.LongestSegment &&
    std::equal(x.ScalarRange, x.ScalarRange + 2, y.ScalarRange) && x.ScalarSize == y.ScalarSize &&
    x.LengthSize == y.LengthSize && x.AnyScale == y.AnyScale && x.Scale == y.Scale &&
    x.AnyAxis == y.AnyAxis && x.Axis == y.Axis && x.AnyFormat == y.AnyFormat &&
    x.Format == y.Format;
}

} // namespace

bool SegmentTable::Update(const TransferFunction& function, const Request& request)
{
  const bool sameFunction = this->Decided && AreEqual(function, this->Function);
  const bool sameRequest = this->Decided && AreEqual(request, this->Last);
  if (sameFunction && sameRequest && (!this->Coarse || request.Interactive))
  {
    return false;
  }
  const bool hadTable = this->Table != nullptr;
  this->Decided = false;

  if (request.Interactive && !request.Goal.AlwaysTable)
  {
    // The closed form is right for any function: none is tried before the frame is there to stay.
    this->Coarse = true;
    this->Reason = "closed form: no table is tried during interaction";
    this->PictureError = 0;
    this->Table = nullptr;
  }
  else if (request.Interactive)
  {
    // Whichever the right settings are, coarse ones of the same axes do for now.
    PreIntegrationSettings settings;
    settings.Axis = request.Goal.AnyAxis ? ScalarAxis::Nodes : request.Goal.Axis;
    settings.Scale = request.Goal.AnyScale ? LengthScale::Logarithmic : request.Goal.Scale;
    settings.Format = request.Goal.AnyFormat ? TexelFormat::Float : request.Goal.Format;
    settings.ScalarSize = request.Goal.ScalarSize > 0 ? request.Goal.ScalarSize : 128;
    settings.LengthSize = request.Goal.LengthSize > 0 ? request.Goal.LengthSize : 64;
    std::copy_n(request.Goal.ScalarRange, 2, settings.ScalarRange);
    settings.LongestSegment = request.Goal.LongestSegment;
    this->Coarse = true;
    this->Build(function, GetCoarseSettings(settings, CoarseBytes));
    this->PictureError = EstimatePictureError(function, *this->Table, TakeFew(*request.Goal.Rays));
    this->Reason = "a coarse table during interaction";
  }
  else
  {
    TableChoice choice = ChoosePreIntegrationTable(function, request.Goal);
    if (!choice.Table && request.Goal.AlwaysTable)
    {
      throw std::invalid_argument(
        "no table of the sizes that are asked for fits into TableMaximumBytes");
    }
    this->Coarse = false;
    this->Reason = choice.Reason;
    this->PictureError = choice.PictureError;
    this->Table = std::move(choice.Table);
  }
  this->Function = function;
  this->Last = request;
  this->Decided = true;
  return hadTable || this->Table;
}

void SegmentTable::Build(const TransferFunction& function, const PreIntegrationSettings& settings)
{
  const auto isSame = [&](const PreIntegrationSettings& s)
  {
    return s.ScalarSize == settings.ScalarSize && s.LengthSize == settings.LengthSize &&
      s.Scale == settings.Scale && s.StepsPerDoubling == settings.StepsPerDoubling &&
      s.Axis == settings.Axis && s.Format == settings.Format &&
      std::equal(s.ScalarRange, s.ScalarRange + 2, settings.ScalarRange) &&
      s.LongestSegment == settings.LongestSegment;
  };
  if (this->Table && !this->Function.Nodes.empty() && isSame(this->Table->Settings))
  {
    UpdatePreIntegrationTable(this->Function, function, *this->Table);
    return;
  }
  this->Function.Nodes.clear(); // no longer what the table is of, should the next line throw
  if (!this->Table)
  {
    this->Table = std::make_shared<PreIntegrationTable>();
  }
  BuildPreIntegrationTable(function, settings, *this->Table);
}

} // namespace tetralux
