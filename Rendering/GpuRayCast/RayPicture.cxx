// SPDX-License-Identifier: BSD-3-Clause
#include "GpuRayCast/RayPicture.h"

#include "vtkOpenGLRenderWindow.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tetralux
{

void RayPicture::Prepare(
  vtkOpenGLRenderWindow* window, int width, int height, int rowsOfBand, bool countsSteps)
{
  const auto bands = static_cast<std::size_t>((height + rowsOfBand - 1) / rowsOfBand);
  while (this->Bands.size() > bands)
  {
    this->Bands.back().ReleaseGraphicsResources(window);
    this->Bands.pop_back();
  }
  while (this->Bands.size() < bands)
  {
    this->Bands.emplace_back();
  }
  this->Width = width;
  this->Height = height;
  this->RowsOfBand = rowsOfBand;
  FloatTarget::Settings settings;
  settings.Width = width;
  settings.Pictures = { { 4, ChannelFormat::Float }, { 1, ChannelFormat::Float } };
  if (countsSteps)
  {
    settings.Pictures.push_back({ 1, ChannelFormat::Float });
  }
  for (int band = 0; band < this->GetNumberOfBands(); ++band)
  {
    settings.Height = std::min(rowsOfBand, height - this->GetFirstRow(band));
    this->GetBand(band).Prepare(window, settings);
  }
}

void RayPicture::Read(Channel channel, Span<float> values)
{
  float* target = values.data();
  for (FloatTarget& band : this->Bands)
  {
    const FloatTarget::Settings& settings = band.GetSettings();
    const std::size_t size = static_cast<std::size_t>(settings.Width) *
      static_cast<std::size_t>(settings.Height) *
      static_cast<std::size_t>(settings.Pictures[channel].Components);
    band.Read(channel, { target, size });
    target += size;
  }
}

std::int64_t RayPicture::CountSteps()
{
  std::vector<float> values(
    static_cast<std::size_t>(this->Width) * static_cast<std::size_t>(this->Height));
  this->Read(Steps, values);
  std::int64_t steps = 0;
  for (const float value : values)
  {
    steps += std::lround(value);
  }
  return steps;
}

std::size_t RayPicture::GetNumberOfBytes() const
{
  std::size_t bytes = 0;
  for (const FloatTarget& band : this->Bands)
  {
    bytes += band.GetNumberOfBytes();
  }
  return bytes;
}

void RayPicture::ReleaseGraphicsResources(vtkWindow* window)
{
  for (FloatTarget& band : this->Bands)
  {
    band.ReleaseGraphicsResources(window);
  }
}

} // namespace tetralux
