// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_LaneOperations_h
#define tetralux_LaneOperations_h

// Every operation on lanes, as compiled for one instruction set, behind plain functions. The list
// of operations stands once: TestLanes.cxx evaluates its expressions with scalars,
// LaneOperations.inl with lanes.

#include "Simd/LaneCount.h"

#include <cstdint>

namespace tetralux
{

/// What expressions are made of.
struct LaneInput
{
  float A[LaneCount], B[LaneCount], C[LaneCount];
  float T[LaneCount]; ///< in the range of an integer
  double P[LaneCount], Q[LaneCount], R[LaneCount];
  std::int32_t I[LaneCount], J[LaneCount]; ///< sums and differences do not overflow
  std::int32_t K[LaneCount], L[LaneCount]; ///< products do not overflow
  unsigned M, N;                           ///< masks, one bit a lane
};

/// What an expression comes to. Each operation writes one of these.
struct LaneResult
{
  float Floats[LaneCount];
  double Doubles[LaneCount];
  std::int32_t Integers[LaneCount];
  unsigned Masks; ///< one bit a lane
};

/// How results are compared.
enum class LaneComparison
{
  Floats,   ///< not-a-number is like any other
  Doubles,  ///< not-a-number is like any other
  Bits,     ///< of floats
  LongBits, ///< of doubles
  Integers,
  Masks
};

struct LaneOperation
{
  const char* Name;
  LaneComparison Comparison;
  void (*Compute)(const LaneInput& in, LaneResult& result);
};

/// The operations of one instruction set.
struct LaneOperations
{
  const LaneOperation* Operations;
  int Count;
  bool FusesMultiplyAdd; ///< Fma rounds once

  bool (*Any)(unsigned mask);
  float (*GetFloatLane)(const float* a, int lane);
  double (*GetDoubleLane)(const double* a, int lane);
  void (*DifferenceOfFloats)(
    const float* a, const float* b, const float* c, const float* d, float* result);
  void (*DifferenceOfDoubles)(
    const double* a, const double* b, const double* c, const double* d, double* result);
  void (*GatherFloats)(const float* base, const std::int32_t* index, float (*columns)[LaneCount]);
  void (*GatherDoubles)(
    const double* base, const std::int32_t* index, double (*columns)[LaneCount]);
  void (*LoadRows)(const double* const (&rows)[LaneCount], double (*columns)[LaneCount]);
  void (*StoreWhere)(unsigned mask, std::int64_t value, std::int64_t* values);
  void (*GatherIntegers)(
    const std::int32_t* base, const std::int32_t* index, std::int32_t (*columns)[LaneCount]);
  void (*GatherWords)(const void* base, const std::int32_t* index, std::int32_t* words);
  void (*GatherNeighbors)(
    const float* base, const std::int32_t* index, float* first, float* second);
  void (*LookUpFew)(const float (&table)[LaneCount], const std::int32_t* index, float* found);
  void (*LookUpMore)(const float (&table)[2 * LaneCount], const std::int32_t* index, float* found);
};

LaneOperations GetLaneOperationsGeneric();
#ifdef TETRALUX_HAVE_AVX2_KERNEL
LaneOperations GetLaneOperationsAvx2();
LaneOperations GetLaneOperationsAvx512(); ///< of 16 lanes in a program of their own
#endif

/// Of the test of Polynomial.
constexpr float LaneCoefficients[] = { 1.f, -0.5f, 0.3f, 1e-3f };

} // namespace tetralux

/// OPERATION(field of LaneResult, comparison, name, expression of the inputs in lower case)
#define TETRALUX_LANE_OPERATIONS(OPERATION)                                                        \
  OPERATION(Floats, Floats, AddFloats, a + b)                                                      \
  OPERATION(Floats, Floats, SubtractFloats, a - b)                                                 \
  OPERATION(Floats, Floats, MultiplyFloats, a* b)                                                  \
  OPERATION(Floats, Floats, DivideFloats, a / b)                                                   \
  OPERATION(Floats, Floats, FmaFloats, Fma(a, b, c))                                               \
  OPERATION(Floats, Floats, SqrtFloats, Sqrt(a))                                                   \
  OPERATION(Floats, Bits, MinFloats, Min(a, b))                                                    \
  OPERATION(Floats, Bits, MaxFloats, Max(a, b))                                                    \
  OPERATION(Floats, Bits, AbsFloats, Abs(a))                                                       \
  OPERATION(Floats, Bits, SelectFloats, Select(m, a, b))                                           \
  OPERATION(Floats, Bits, KeepFloats, Keep(m, a))                                                  \
  OPERATION(Floats, Bits, FloatFromBits, FromBits(i))                                              \
  OPERATION(Floats, Floats, IntegerToFloat, ToFloat(i))                                            \
  OPERATION(Floats, Floats, DoubleToFloat, ToFloat(p))                                             \
  OPERATION(Floats, Bits, FloatToFloat, ToFloat(a))                                                \
  OPERATION(Floats, Floats, PolynomialOfFloats, Polynomial(a, LaneCoefficients))                   \
  OPERATION(Masks, Masks, LessFloats, a < b)                                                       \
  OPERATION(Masks, Masks, LessOrEqualFloats, a <= b)                                               \
  OPERATION(Masks, Masks, EqualFloats, a == b)                                                     \
  OPERATION(Doubles, Doubles, AddDoubles, p + q)                                                   \
  OPERATION(Doubles, Doubles, SubtractDoubles, p - q)                                              \
  OPERATION(Doubles, Doubles, MultiplyDoubles, p* q)                                               \
  OPERATION(Doubles, Doubles, DivideDoubles, p / q)                                                \
  OPERATION(Doubles, Doubles, FmaDoubles, Fma(p, q, r))                                            \
  OPERATION(Doubles, Doubles, SqrtDoubles, Sqrt(p))                                                \
  OPERATION(Doubles, LongBits, MinDoubles, Min(p, q))                                              \
  OPERATION(Doubles, LongBits, MaxDoubles, Max(p, q))                                              \
  OPERATION(Doubles, LongBits, AbsDoubles, Abs(p))                                                 \
  OPERATION(Doubles, LongBits, SelectDoubles, Select(m, p, q))                                     \
  OPERATION(Doubles, LongBits, KeepDoubles, Keep(m, p))                                            \
  OPERATION(Doubles, Doubles, FloatToDouble, ToDouble(a))                                          \
  OPERATION(Masks, Masks, LessDoubles, p < q)                                                      \
  OPERATION(Masks, Masks, LessOrEqualDoubles, p <= q)                                              \
  OPERATION(Masks, Masks, EqualDoubles, p == q)                                                    \
  OPERATION(Integers, Integers, AddIntegers, i + j)                                                \
  OPERATION(Integers, Integers, SubtractIntegers, i - j)                                           \
  OPERATION(Integers, Integers, MultiplyIntegers, k* l)                                            \
  OPERATION(Integers, Integers, ShiftLeftNot, ShiftLeft(i, 0))                                     \
  OPERATION(Integers, Integers, ShiftLeftByTwo, ShiftLeft(i, 2))                                   \
  OPERATION(Integers, Integers, ShiftLeftByAll, ShiftLeft(i, 31))                                  \
  OPERATION(Integers, Integers, ShiftLeftByLanes, ShiftLeft(i, ShiftLeft(Ones(m), 4) + Ones(n)))   \
  OPERATION(Integers, Integers, ShiftRightNot, ShiftRight(i, 0))                                   \
  OPERATION(Integers, Integers, ShiftRightBySeven, ShiftRight(i, 7))                               \
  OPERATION(Integers, Integers, ShiftRightByAll, ShiftRight(i, 31))                                \
  OPERATION(Integers, Integers, ShiftRightSignedBySeven, ShiftRightSigned(i, 7))                   \
  OPERATION(Integers, Integers, ShiftRightSignedByAll, ShiftRightSigned(i, 31))                    \
  OPERATION(Integers, Integers, SelectIntegers, Select(m, i, j))                                   \
  OPERATION(Integers, Integers, OnesOfMask, Ones(m))                                               \
  OPERATION(Integers, Integers, FloatToBits, ToBits(a))                                            \
  OPERATION(Integers, Integers, RoundFloats, RoundToInt(t))                                        \
  OPERATION(Masks, Masks, GreaterIntegers, i > j)                                                  \
  OPERATION(Masks, Masks, EqualIntegers, k == l)                                                   \
  OPERATION(Masks, Masks, MaskOfBits, m)                                                           \
  OPERATION(Masks, Masks, AndMasks, m& n)                                                          \
  OPERATION(Masks, Masks, OrMasks, m | n)                                                          \
  OPERATION(Masks, Masks, AndNotMasks, AndNot(m, n))

#endif
