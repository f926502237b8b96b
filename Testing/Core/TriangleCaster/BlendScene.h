// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_BlendScene_h
#define tetralux_BlendScene_h

// Pictures of image data by all blend modes: by the triangle caster, and in plain loops.

#include "TriangleCaster/ImageCaster.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <vector>

namespace tetralux
{

constexpr float NotANumber = std::numeric_limits<float>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();

constexpr std::array<ImageBlend, 6> Blends = { ImageBlend::MaximumIntensity,
  ImageBlend::MinimumIntensity, ImageBlend::AverageIntensity, ImageBlend::Additive,
  ImageBlend::Isosurfaces, ImageBlend::Slice };

/// Of a channel: some hundred roundings of single precision, of scalars and of positions.
constexpr double RoundingError = 1e-5;

/// Everything that a picture is made of. Values are whole numbers of 0..100 unless a test changes
/// them, and scalars are the same.
struct BlendScene
{
  std::array<int, 3> Dimensions{};
  std::vector<float> Values; ///< as ImageVolume has them
  std::vector<unsigned char> PointFlags, Mask;
  ImageScalar Type = ImageScalar::Float;
  double Scale = 1;
  double Offset = 0;
  ImageOptics Optics;
  RayGrid Grid;
  RayLimits Limits;
  std::vector<float> MaximumDistances;
  ImageCasterOptions Options;

  float& At(int i, int j, int k)
  {
    return this
      ->Values[(static_cast<std::size_t>(k) * this->Dimensions[1] + j) * this->Dimensions[0] + i];
  }

  void Fill(const std::function<double(int, int, int)>& value)
  {
    this->Values.assign(
      static_cast<std::size_t>(this->Dimensions[0]) * this->Dimensions[1] * this->Dimensions[2], 0);
    for (int k = 0; k < this->Dimensions[2]; ++k)
    {
      for (int j = 0; j < this->Dimensions[1]; ++j)
      {
        for (int i = 0; i < this->Dimensions[0]; ++i)
        {
          this->At(i, j, k) = static_cast<float>(value(i, j, k));
        }
      }
    }
  }
};

struct BlendPicture
{
  std::vector<float> Colors, Depths;
  ImageCastStatistics Statistics;

  bool operator==(const BlendPicture& other) const
  {
    return std::memcmp(this->Colors.data(), other.Colors.data(), 4 * this->Colors.size()) == 0 &&
      std::memcmp(this->Depths.data(), other.Depths.data(), 4 * this->Depths.size()) == 0;
  }
};

const char* GetName(ImageBlend blend);

BlendPicture Cast(const BlendScene& scene);

/// Compares a picture with the plain loops, pixels without doubt. Returns how many pixels show
/// anything.
int ExpectPlain(const BlendScene& scene, const BlendPicture& picture);

/// A number between low and high.
double Uniform(std::mt19937& random, double low, double high);

/// What is large becomes small.
void Invert(BlendScene& scene);

/// Rays onto the middle of the volume, from a point outside of it.
void SetView(BlendScene& scene, std::mt19937& random, bool parallel);

/// A function of 0..100 that is transparent up to about 25.
TransferFunction MakeFunction(std::mt19937& random, int nodes);

/// A scene of a blend mode. nodes: of its function.
BlendScene MakeBlendScene(std::mt19937& random, ImageBlend blend, bool parallel, int nodes);

/// Calls check with a scene of each blend mode in both projections.
void ForEachScene(int nodes, const std::function<void(BlendScene&, std::mt19937&)>& check);

} // namespace tetralux

#endif
