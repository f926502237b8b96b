// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_GraphicsMemory_h
#define tetralux_GraphicsMemory_h

#include "TetraluxRenderingModule.h"

#include <stdexcept>
#include <string>

namespace tetralux
{

/// The graphics card has no memory for something; one line.
class OutOfGraphicsMemory : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Tells whether the driver has the memory for what is made while one lives: VTK's textures do not.
/// For the current context.
class TETRALUXRENDERING_EXPORT GraphicsMemoryCheck
{
public:
  /// Forgets the errors of others.
  GraphicsMemoryCheck();

  /// Throws OutOfGraphicsMemory where there was none left for something since. content: what a
  /// message calls it.
  void Finish(const std::string& content) const;
};

} // namespace tetralux

#endif
