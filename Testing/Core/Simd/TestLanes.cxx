// SPDX-License-Identifier: BSD-3-Clause

// Lanes of every instruction set against plain scalar arithmetic.
#include "LaneOperations.h"

#include "Simd/InstructionSet.h"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace
{

using namespace tetralux;

constexpr unsigned Seed = 20240;

// ------------------------------------------------------------------------------------------------
// The same operations with scalars

/// fused: whether Fma rounds once.
template <bool Fused>
struct Scalar
{
  template <class T>
  static T Fma(T a, T b, T c)
  {
    return Fused ? std::fma(a, b, c) : a * b + c;
  }
  template <class T>
  static T Sqrt(T a)
  {
    return std::sqrt(a);
  }
  template <class T>
  static T Min(T a, T b)
  {
    return a < b ? a : b;
  }
  template <class T>
  static T Max(T a, T b)
  {
    return a > b ? a : b;
  }
  template <class T>
  static T Abs(T a)
  {
    return std::fabs(a);
  }
  template <class T>
  static T Select(bool m, T a, T b)
  {
    return m ? a : b;
  }
  template <class T>
  static T Keep(bool m, T a)
  {
    return m ? a : T(0);
  }
  static float FromBits(std::int32_t a)
  {
    float result;
    std::memcpy(&result, &a, sizeof(a));
    return result;
  }
  static std::int32_t ToBits(float a)
  {
    std::int32_t result;
    std::memcpy(&result, &a, sizeof(a));
    return result;
  }
  template <class T>
  static float ToFloat(T a)
  {
    return static_cast<float>(a);
  }
  static double ToDouble(float a) { return a; }
  static std::int32_t ShiftLeft(std::int32_t a, int bits)
  {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) << bits);
  }
  static std::int32_t ShiftRight(std::int32_t a, int bits)
  {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) >> bits);
  }
  static std::int32_t ShiftRightSigned(std::int32_t a, int bits)
  {
    // Halved by division, which rounds towards zero.
    std::int64_t value = a;
    for (int i = 0; i < bits; ++i)
    {
      value = value < 0 ? -((1 - value) / 2) : value / 2;
    }
    return static_cast<std::int32_t>(value);
  }
  static std::int32_t Ones(bool m) { return m ? 1 : 0; }
  /// Ties to even by hand: not by the rounding mode.
  static std::int32_t RoundToInt(float a)
  {
    const double below = std::floor(static_cast<double>(a));
    const double rest = a - below;
    const auto lower = static_cast<std::int64_t>(below);
    const bool up = rest > 0.5 || (rest == 0.5 && lower % 2 != 0);
    return static_cast<std::int32_t>(lower + (up ? 1 : 0));
  }
  static bool AndNot(bool m, bool n) { return m && !n; }
  template <int N>
  static float Polynomial(float x, const float (&c)[N])
  {
    float sum = c[N - 1];
    for (int i = N - 2; i >= 0; --i)
    {
      sum = Fma(sum, x, c[i]);
    }
    return sum;
  }

#define STORE_Floats(value) result.Floats[lane] = (value)
#define STORE_Doubles(value) result.Doubles[lane] = (value)
#define STORE_Integers(value) result.Integers[lane] = (value)
#define STORE_Masks(value) result.Masks |= ((value) ? 1u : 0u) << lane
#define COMPUTE(field, comparison, name, expression)                                               \
  static void Compute##name(const LaneInput& in, LaneResult& result)                               \
  {                                                                                                \
    result.Masks = 0;                                                                              \
    for (int lane = 0; lane < LaneCount; ++lane)                                                   \
    {                                                                                              \
      [[maybe_unused]] const float a = in.A[lane], b = in.B[lane], c = in.C[lane], t = in.T[lane]; \
      [[maybe_unused]] const double p = in.P[lane], q = in.Q[lane], r = in.R[lane];                \
      [[maybe_unused]] const std::int32_t i = in.I[lane], j = in.J[lane];                          \
      [[maybe_unused]] const std::int32_t k = in.K[lane], l = in.L[lane];                          \
      [[maybe_unused]] const bool m = (in.M >> lane) & 1u, n = (in.N >> lane) & 1u;                \
      STORE_##field(expression);                                                                   \
    }                                                                                              \
  }
  TETRALUX_LANE_OPERATIONS(COMPUTE)
#undef COMPUTE

  static std::vector<LaneOperation> GetOperations()
  {
#define NAME(field, comparison, name, expression)                                                  \
  { #name, LaneComparison::comparison, &Scalar::Compute##name },
    return { TETRALUX_LANE_OPERATIONS(NAME) };
#undef NAME
  }
};

// ------------------------------------------------------------------------------------------------
// Numbers

template <class T, class Bits>
T MakeFromBits(Bits bits)
{
  static_assert(sizeof(T) == sizeof(Bits), "all bits of the number");
  T result;
  std::memcpy(&result, &bits, sizeof(bits));
  return result;
}

/// Where arithmetic has its corners.
template <class T>
std::vector<T> GetCorners()
{
  using Limits = std::numeric_limits<T>;
  std::vector<T> corners;
  for (const T x :
    { T(0), Limits::denorm_min(), T(3) * Limits::denorm_min(), std::nextafter(Limits::min(), T(0)),
      Limits::min(), Limits::epsilon(), T(0.5), T(1), std::nextafter(T(1), T(2)), T(1.5), T(2.5),
      T(3), T(1e30), Limits::max() / 2, Limits::max(), Limits::infinity(), Limits::quiet_NaN() })
  {
    corners.push_back(x);
    corners.push_back(-x);
  }
  return corners;
}

/// Any bits at all, ordinary numbers, and corners.
template <class T, class Bits>
T DrawNumber(std::mt19937_64& generator)
{
  static const std::vector<T> corners = GetCorners<T>();
  switch (generator() % 3)
  {
    case 0:
      return MakeFromBits<T>(static_cast<Bits>(generator()));
    case 1:
      return std::uniform_real_distribution<T>(-10, 10)(generator);
    default:
      return corners[generator() % corners.size()];
  }
}

float DrawFloat(std::mt19937_64& generator) { return DrawNumber<float, std::uint32_t>(generator); }

double DrawDouble(std::mt19937_64& generator)
{
  return DrawNumber<double, std::uint64_t>(generator);
}

/// Integers, ties and their neighbours, in the range that int32 holds.
float DrawRoundable(std::mt19937_64& generator)
{
  const float magnitude = std::ldexp(1.f, static_cast<int>(generator() % 31));
  const float x = std::uniform_real_distribution<float>(-magnitude, magnitude)(generator);
  switch (generator() % 4)
  {
    case 0:
      return std::floor(x);
    case 1:
      return std::floor(x) + 0.5f;
    case 2:
      return std::nextafter(std::floor(x) + 0.5f, x);
    default:
      return generator() % 2 ? x : std::copysign(0.f, x);
  }
}

std::int32_t DrawInteger(std::mt19937_64& generator, std::int32_t largest)
{
  const std::int32_t corners[] = { 0, 1, -1, 2, largest, -largest, largest - 1 };
  const auto any = static_cast<std::int32_t>(generator() % (2 * std::int64_t{ largest } + 1));
  return generator() % 3 == 0 ? corners[generator() % 7] : any - largest;
}

LaneInput DrawInput(std::mt19937_64& generator)
{
  constexpr std::int32_t LargestTerm = (1 << 30) - 1;
  constexpr std::int32_t LargestFactor = 46340; // its square is below 2^31
  LaneInput in;
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    in.A[lane] = DrawFloat(generator);
    in.B[lane] = generator() % 8 == 0 ? in.A[lane] : DrawFloat(generator);
    in.C[lane] = DrawFloat(generator);
    in.T[lane] = DrawRoundable(generator);
    in.P[lane] = DrawDouble(generator);
    in.Q[lane] = generator() % 8 == 0 ? in.P[lane] : DrawDouble(generator);
    in.R[lane] = DrawDouble(generator);
    // In the range of floats, too: for conversions.
    in.P[lane] = generator() % 4 == 0 ? static_cast<double>(in.A[lane]) * (1 + 1e-8) : in.P[lane];
    in.I[lane] = DrawInteger(generator, LargestTerm);
    in.J[lane] = generator() % 8 == 0 ? in.I[lane] : DrawInteger(generator, LargestTerm);
    in.K[lane] = DrawInteger(generator, LargestFactor);
    in.L[lane] = generator() % 8 == 0 ? in.K[lane] : DrawInteger(generator, LargestFactor);
  }
  in.M = static_cast<unsigned>(generator()) & AllLanes;
  in.N = static_cast<unsigned>(generator()) & AllLanes;
  return in;
}

/// Every pair of corners, and drawn numbers.
std::vector<LaneInput> MakeInputs()
{
  std::mt19937_64 generator(Seed);
  std::vector<LaneInput> inputs;
  const std::vector<float> floats = GetCorners<float>();
  const std::vector<double> doubles = GetCorners<double>();
  const std::size_t n = floats.size();
  for (std::size_t pair = 0; pair < n * n; pair += LaneCount)
  {
    LaneInput in = DrawInput(generator);
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      const std::size_t first = (pair + lane) / n % n;
      const std::size_t second = (pair + lane) % n;
      in.A[lane] = floats[first];
      in.B[lane] = floats[second];
      in.P[lane] = doubles[first];
      in.Q[lane] = doubles[second];
    }
    inputs.push_back(in);
  }
  constexpr int DrawnInputs = 5000;
  for (int k = 0; k < DrawnInputs; ++k)
  {
    inputs.push_back(DrawInput(generator));
  }
  return inputs;
}

// ------------------------------------------------------------------------------------------------
// Comparison

template <class T>
bool HaveSameBits(const T& a, const T& b)
{
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

template <class T>
bool AreEqual(T a, T b)
{
  return HaveSameBits(a, b) || (std::isnan(a) && std::isnan(b));
}

/// Whether a lane's results agree.
bool AreEqual(LaneComparison comparison, const LaneResult& a, const LaneResult& b, int lane)
{
  switch (comparison)
  {
    case LaneComparison::Floats:
      return AreEqual(a.Floats[lane], b.Floats[lane]);
    case LaneComparison::Doubles:
      return AreEqual(a.Doubles[lane], b.Doubles[lane]);
    case LaneComparison::Bits:
      return HaveSameBits(a.Floats[lane], b.Floats[lane]);
    case LaneComparison::LongBits:
      return HaveSameBits(a.Doubles[lane], b.Doubles[lane]);
    case LaneComparison::Integers:
      return a.Integers[lane] == b.Integers[lane];
    case LaneComparison::Masks:
      return ((a.Masks ^ b.Masks) >> lane & 1u) == 0;
  }
  return false;
}

std::string Describe(const LaneInput& in, const LaneResult& result, int lane)
{
  std::ostringstream text;
  text.precision(17);
  text << "a " << in.A[lane] << ", b " << in.B[lane] << ", c " << in.C[lane] << ", t " << in.T[lane]
       << ", p " << in.P[lane] << ", q " << in.Q[lane] << ", r " << in.R[lane] << ", i "
       << in.I[lane] << ", j " << in.J[lane] << ", k " << in.K[lane] << ", l " << in.L[lane]
       << ", m " << (in.M >> lane & 1u) << ", n " << (in.N >> lane & 1u) << ": float "
       << result.Floats[lane] << ", double " << result.Doubles[lane] << ", integer "
       << result.Integers[lane] << ", mask " << (result.Masks >> lane & 1u);
  return text.str();
}

class Lanes : public testing::TestWithParam<InstructionSet>
{
protected:
  void SetUp() override
  {
#if TETRALUX_LANE_COUNT == 16
    if (GetWidestInstructionSet() != InstructionSet::Avx512)
    {
      GTEST_SKIP() << "this processor has no AVX-512";
    }
    this->Tested = GetLaneOperationsAvx512();
#else
#ifdef TETRALUX_HAVE_AVX2_KERNEL
    if (this->GetParam() == InstructionSet::Avx512)
    {
      if (GetWidestInstructionSet() != InstructionSet::Avx512)
      {
        GTEST_SKIP() << "this processor has no AVX-512";
      }
      this->Tested = GetLaneOperationsAvx512();
      return;
    }
    if (this->GetParam() == InstructionSet::Avx2)
    {
      if (GetInstructionSet() != InstructionSet::Avx2)
      {
        GTEST_SKIP() << "this processor has no AVX2";
      }
      this->Tested = GetLaneOperationsAvx2();
      return;
    }
#endif
    this->Tested = GetLaneOperationsGeneric();
#endif
  }

  LaneOperations Tested{};
};

TEST_P(Lanes, OperationsAreThoseOfScalars)
{
  const std::vector<LaneOperation> expected =
    this->Tested.FusesMultiplyAdd ? Scalar<true>::GetOperations() : Scalar<false>::GetOperations();
  ASSERT_EQ(this->Tested.Count, static_cast<int>(expected.size()));
  const std::vector<LaneInput> inputs = MakeInputs();
  for (int k = 0; k < this->Tested.Count; ++k)
  {
    const LaneOperation& tested = this->Tested.Operations[k];
    ASSERT_STREQ(tested.Name, expected[k].Name);
    int failures = 0;
    for (const LaneInput& in : inputs)
    {
      LaneResult result{}, wanted{};
      tested.Compute(in, result);
      expected[k].Compute(in, wanted);
      for (int lane = 0; lane < LaneCount; ++lane)
      {
        if (!AreEqual(tested.Comparison, result, wanted, lane) && ++failures <= 3)
        {
          ADD_FAILURE() << tested.Name << ": " << Describe(in, result, lane) << "\nexpected "
                        << Describe(in, wanted, lane) << "\nseed " << Seed;
        }
      }
    }
    EXPECT_EQ(failures, 0) << tested.Name;
  }
}

TEST_P(Lanes, AnyTellsWhetherALaneIsSet)
{
  for (unsigned bits = 0; bits <= AllLanes; ++bits)
  {
    EXPECT_EQ(this->Tested.Any(bits), bits != 0) << bits;
  }
}

TEST_P(Lanes, LanesAreInOrder)
{
  const LaneInput in = MakeInputs().front();
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    EXPECT_TRUE(HaveSameBits(this->Tested.GetFloatLane(in.A, lane), in.A[lane])) << lane;
    EXPECT_TRUE(HaveSameBits(this->Tested.GetDoubleLane(in.P, lane), in.P[lane])) << lane;
  }
}

/// Factors of two products that are equal, nearly equal or not. Their exponents are so small that
/// no product overflows, and no rounding error underflows.
template <class T>
void DrawFactors(std::mt19937_64& generator, T (&factors)[4])
{
  const int largestExponent = std::numeric_limits<T>::max_exponent / 4;
  for (T& factor : factors)
  {
    const int exponent =
      static_cast<int>(generator() % (2 * largestExponent + 1)) - largestExponent;
    factor = std::ldexp(std::uniform_real_distribution<T>(-1, 1)(generator), exponent);
  }
  const auto nudge = [&](T x)
  {
    const int steps = static_cast<int>(generator() % 5) - 2;
    return x + static_cast<T>(steps) * std::numeric_limits<T>::epsilon() * x;
  };
  switch (generator() % 4)
  {
    case 0:
      factors[2] = factors[0];
      factors[3] = factors[1];
      break;
    case 1:
      factors[2] = nudge(factors[1]);
      factors[3] = nudge(factors[0]);
      break;
    case 2:
      factors[generator() % 4] = generator() % 2 ? T(0) : -T(0);
      break;
    default:
      break;
  }
}

template <class T>
void TestDifferenceOfProducts(
  void (*difference)(const T*, const T*, const T*, const T*, T*), const char* type)
{
  // Products are exact: 113 bits.
  using Exact = boost::multiprecision::cpp_bin_float_quad;
  constexpr double LargestError = 1.5; // units in the last place
  std::mt19937_64 generator(Seed);
  int cancellations = 0;
  for (int trial = 0; trial < 20000; ++trial)
  {
    T a[LaneCount], b[LaneCount], c[LaneCount], d[LaneCount], result[LaneCount];
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      T factors[4];
      DrawFactors(generator, factors);
      a[lane] = factors[0];
      b[lane] = factors[1];
      c[lane] = factors[2];
      d[lane] = factors[3];
    }
    difference(a, b, c, d, result);
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      const Exact left = Exact(a[lane]) * Exact(b[lane]);
      const Exact exact = left - Exact(c[lane]) * Exact(d[lane]);
      const std::string where =
        std::string(type) + " " + std::to_string(trial) + ", seed " + std::to_string(Seed);
      ASSERT_EQ(exact > 0, result[lane] > 0) << where;
      ASSERT_EQ(exact < 0, result[lane] < 0) << where;
      const T near = std::fabs(static_cast<T>(exact));
      const Exact ulp = Exact(near) - Exact(std::nextafter(near, T(0)));
      ASSERT_LE(abs(Exact(result[lane]) - exact), LargestError * ulp) << where;
      cancellations += exact != 0 && abs(exact) < abs(left) * 1e-6 ? 1 : 0;
    }
  }
  EXPECT_GT(cancellations, 1000);
}

TEST_P(Lanes, DifferencesOfProductsHaveExactSigns)
{
  TestDifferenceOfProducts<float>(this->Tested.DifferenceOfFloats, "float");
  TestDifferenceOfProducts<double>(this->Tested.DifferenceOfDoubles, "double");
}

/// Rows of N values, aligned to their size.
template <class T, int N>
struct alignas(N * sizeof(T)) Row
{
  T Values[N];
};

/// gather(base, index, columns) against the rows themselves, to the bit.
template <class T, int N, class Draw, class Gather>
void TestGather(const Draw& draw, const Gather& gather)
{
  std::mt19937_64 generator(Seed);
  std::vector<Row<T, N>> rows(1000);
  for (Row<T, N>& row : rows)
  {
    for (T& value : row.Values)
    {
      value = draw(generator);
    }
  }
  for (int trial = 0; trial < 1000; ++trial)
  {
    std::int32_t index[LaneCount];
    for (std::int32_t& i : index)
    {
      i = static_cast<std::int32_t>(generator() % rows.size());
    }
    index[trial % LaneCount] = trial % 2 ? 0 : static_cast<std::int32_t>(rows.size() - 1);
    T columns[N][LaneCount];
    gather(rows[0].Values, index, columns);
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      for (int k = 0; k < N; ++k)
      {
        ASSERT_TRUE(HaveSameBits(columns[k][lane], rows[index[lane]].Values[k]))
          << "lane " << lane << ", column " << k << ", seed " << Seed;
      }
    }
  }
}

TEST_P(Lanes, GathersTransposeRows)
{
  TestGather<float, 4>(DrawFloat, this->Tested.GatherFloats);
  TestGather<double, 4>(DrawDouble, this->Tested.GatherDoubles);
  TestGather<double, 4>(DrawDouble,
    [this](const double* base, const std::int32_t* index, double(*columns)[LaneCount])
    {
      const double* rows[LaneCount];
      for (int lane = 0; lane < LaneCount; ++lane)
      {
        rows[lane] = base + 4 * index[lane];
      }
      this->Tested.LoadRows(rows, columns);
    });
  TestGather<std::int32_t, 2>([](std::mt19937_64& generator)
    { return static_cast<std::int32_t>(generator()); },
    this->Tested.GatherIntegers);
}

TEST_P(Lanes, StoresWhereAMaskIsSet)
{
  std::mt19937_64 generator(Seed);
  for (int trial = 0; trial < 1000; ++trial)
  {
    const unsigned mask = static_cast<unsigned>(generator()) & AllLanes;
    const auto value = static_cast<std::int64_t>(generator());
    std::int64_t values[LaneCount + 1], expected[LaneCount + 1];
    for (int i = 0; i <= LaneCount; ++i)
    {
      values[i] = static_cast<std::int64_t>(generator());
      expected[i] = i < LaneCount && (mask >> i & 1) != 0 ? value : values[i];
    }
    this->Tested.StoreWhere(mask, value, values);
    for (int i = 0; i <= LaneCount; ++i)
    {
      ASSERT_EQ(values[i], expected[i]) << "lane " << i << ", seed " << Seed;
    }
  }
}

TEST_P(Lanes, GathersWordsAtAnyByte)
{
  std::mt19937_64 generator(Seed);
  std::vector<unsigned char> bytes(1000);
  for (unsigned char& byte : bytes)
  {
    byte = static_cast<unsigned char>(generator());
  }
  for (int trial = 0; trial < 1000; ++trial)
  {
    std::int32_t index[LaneCount];
    for (std::int32_t& i : index)
    {
      i = static_cast<std::int32_t>(generator() % (bytes.size() - 3));
    }
    index[trial % LaneCount] = trial % 2 ? 0 : static_cast<std::int32_t>(bytes.size() - 4);
    std::int32_t words[LaneCount];
    this->Tested.GatherWords(bytes.data(), index, words);
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      std::int32_t expected;
      std::memcpy(&expected, &bytes[index[lane]], sizeof(expected));
      ASSERT_EQ(words[lane], expected) << "lane " << lane << ", seed " << Seed;
    }
  }
}

TEST_P(Lanes, GathersNeighbors)
{
  std::mt19937_64 generator(Seed);
  std::vector<float> values(1000);
  for (float& value : values)
  {
    value = DrawFloat(generator);
  }
  for (int trial = 0; trial < 1000; ++trial)
  {
    std::int32_t index[LaneCount];
    for (std::int32_t& i : index)
    {
      i = static_cast<std::int32_t>(generator() % (values.size() - 1));
    }
    index[trial % LaneCount] = trial % 2 ? 0 : static_cast<std::int32_t>(values.size() - 2);
    float first[LaneCount], second[LaneCount];
    this->Tested.GatherNeighbors(values.data(), index, first, second);
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      ASSERT_TRUE(HaveSameBits(first[lane], values[index[lane]])) << "lane " << lane;
      ASSERT_TRUE(HaveSameBits(second[lane], values[index[lane] + 1])) << "lane " << lane;
    }
  }
}

TEST_P(Lanes, LookUpTables)
{
  std::mt19937_64 generator(Seed);
  for (int trial = 0; trial < 1000; ++trial)
  {
    float few[LaneCount], more[2 * LaneCount];
    for (float& value : few)
    {
      value = DrawFloat(generator);
    }
    for (float& value : more)
    {
      value = DrawFloat(generator);
    }
    std::int32_t index[LaneCount], indexOfMore[LaneCount];
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      index[lane] = static_cast<std::int32_t>(generator() % LaneCount);
      indexOfMore[lane] = static_cast<std::int32_t>(generator() % (2 * LaneCount));
    }
    float found[LaneCount], foundOfMore[LaneCount];
    this->Tested.LookUpFew(few, index, found);
    this->Tested.LookUpMore(more, indexOfMore, foundOfMore);
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      ASSERT_TRUE(HaveSameBits(found[lane], few[index[lane]])) << "lane " << lane;
      ASSERT_TRUE(HaveSameBits(foundOfMore[lane], more[indexOfMore[lane]])) << "lane " << lane;
    }
  }
}

std::vector<InstructionSet> GetCompiledSets()
{
#if TETRALUX_LANE_COUNT == 16
  return { InstructionSet::Avx512 };
#else
  std::vector<InstructionSet> sets{ InstructionSet::Generic };
#ifdef TETRALUX_HAVE_AVX2_KERNEL
  sets.push_back(InstructionSet::Avx2);
  sets.push_back(InstructionSet::Avx512);
#endif
  return sets;
#endif
}

INSTANTIATE_TEST_SUITE_P(Sets, Lanes, testing::ValuesIn(GetCompiledSets()),
  [](const testing::TestParamInfo<InstructionSet>& set)
  { return std::string(set.param == InstructionSet::Avx512 ? "AVX512Wide" : GetName(set.param)); });

} // namespace
