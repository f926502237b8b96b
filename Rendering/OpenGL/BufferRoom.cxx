// SPDX-License-Identifier: BSD-3-Clause
#include "OpenGL/BufferRoom.h"

namespace tetralux
{
namespace
{

/// Share of the free memory of a graphics card that buffers may take: frames need room, too.
constexpr double MemoryShare = 0.9;

} // namespace

std::string FindObstacle(const std::vector<BufferSize>& buffers, const TexelLimits& limits)
{
  std::int64_t bytes = 0;
  for (const BufferSize& buffer : buffers)
  {
    if (buffer.Texels > limits.MaximumTexels)
    {
      return "the " + std::string(buffer.Content) + " of the mesh take " +
        std::to_string(buffer.Texels) +
        " texels, and texture buffers of this OpenGL have at most " +
        std::to_string(limits.MaximumTexels);
    }
    bytes += buffer.Texels * buffer.BytesPerTexel;
  }
  if (limits.FreeBytes >= 0 &&
    static_cast<double>(bytes) > MemoryShare * static_cast<double>(limits.FreeBytes))
  {
    return "the mesh takes " + std::to_string(bytes) + " bytes on the graphics card, of which " +
      std::to_string(limits.FreeBytes) + " bytes are free";
  }
  return {};
}

} // namespace tetralux
