// SPDX-License-Identifier: BSD-3-Clause

// Compiled once for each instruction set, with the options that the kernels are compiled with.
#include "LaneOperations.h"

#include "Simd/Lanes.h"

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

void StoreMask(unsigned& bits, Mask8 mask) { bits = Bits(mask); }

#define STORE_Floats Store
#define STORE_Doubles Store
#define STORE_Integers Store
#define STORE_Masks StoreMask

#define COMPUTE(field, comparison, name, expression)                                               \
  { #name, LaneComparison::comparison,                                                             \
    [](const LaneInput& in, LaneResult& result)                                                    \
    {                                                                                              \
      [[maybe_unused]] const Float8 a = LoadFloat8(in.A), b = LoadFloat8(in.B);                    \
      [[maybe_unused]] const Float8 c = LoadFloat8(in.C), t = LoadFloat8(in.T);                    \
      [[maybe_unused]] const Double8 p = LoadDouble8(in.P), q = LoadDouble8(in.Q);                 \
      [[maybe_unused]] const Double8 r = LoadDouble8(in.R);                                        \
      [[maybe_unused]] const Int8 i = LoadInt8(in.I), j = LoadInt8(in.J);                          \
      [[maybe_unused]] const Int8 k = LoadInt8(in.K), l = LoadInt8(in.L);                          \
      [[maybe_unused]] const Mask8 m = MaskFromBits(in.M), n = MaskFromBits(in.N);                 \
      STORE_##field(result.field, expression);                                                     \
    } },

constexpr LaneOperation Operations[] = { TETRALUX_LANE_OPERATIONS(COMPUTE) };

LaneOperations MakeLaneOperations()
{
  LaneOperations set;
  set.Operations = Operations;
  set.Count = static_cast<int>(sizeof(Operations) / sizeof(Operations[0]));
  set.FusesMultiplyAdd = TETRALUX_FUSED != 0;
  set.Any = [](unsigned mask) { return Any(MaskFromBits(mask)); };
  set.GetFloatLane = [](const float* a, int lane) { return Lane(LoadFloat8(a), lane); };
  set.GetDoubleLane = [](const double* a, int lane) { return Lane(LoadDouble8(a), lane); };
  set.DifferenceOfFloats =
    [](const float* a, const float* b, const float* c, const float* d, float* result)
  {
    Store(result, DifferenceOfProducts(LoadFloat8(a), LoadFloat8(b), LoadFloat8(c), LoadFloat8(d)));
  };
  set.DifferenceOfDoubles =
    [](const double* a, const double* b, const double* c, const double* d, double* result)
  {
    Store(
      result, DifferenceOfProducts(LoadDouble8(a), LoadDouble8(b), LoadDouble8(c), LoadDouble8(d)));
  };
  set.GatherFloats = [](const float* base, const std::int32_t* index, float(*columns)[LaneCount])
  {
    Float8 x, y, z, s;
    GatherRows(base, LoadInt8(index), x, y, z, s);
    Store(columns[0], x);
    Store(columns[1], y);
    Store(columns[2], z);
    Store(columns[3], s);
  };
  set.GatherDoubles = [](const double* base, const std::int32_t* index, double(*columns)[LaneCount])
  {
    Double8 x, y, z, s;
    GatherRows(base, LoadInt8(index), x, y, z, s);
    Store(columns[0], x);
    Store(columns[1], y);
    Store(columns[2], z);
    Store(columns[3], s);
  };
  set.LoadRows = [](const double* const(&rows)[LaneCount], double(*columns)[LaneCount])
  {
    Double8 x, y, z, s;
    LoadRows(rows, x, y, z, s);
    Store(columns[0], x);
    Store(columns[1], y);
    Store(columns[2], z);
    Store(columns[3], s);
  };
  set.StoreWhere = [](unsigned mask, std::int64_t value, std::int64_t* values)
  { StoreWhere(MaskFromBits(mask), value, values); };
  set.GatherIntegers =
    [](const std::int32_t* base, const std::int32_t* index, std::int32_t(*columns)[LaneCount])
  {
    Int8 first, second;
    GatherPairs(base, LoadInt8(index), first, second);
    Store(columns[0], first);
    Store(columns[1], second);
  };
  set.GatherWords = [](const void* base, const std::int32_t* index, std::int32_t* words)
  { Store(words, GatherWords(base, LoadInt8(index))); };
  set.GatherNeighbors = [](
                          const float* base, const std::int32_t* index, float* first, float* second)
  {
    Float8 a, b;
    GatherNeighbors(base, LoadInt8(index), a, b);
    Store(first, a);
    Store(second, b);
  };
  set.LookUpFew = [](const float(&table)[LaneCount], const std::int32_t* index, float* found)
  { Store(found, LookUp(table, LoadInt8(index))); };
  set.LookUpMore = [](const float(&table)[2 * LaneCount], const std::int32_t* index, float* found)
  { Store(found, LookUp(table, LoadInt8(index))); };
  return set;
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux
