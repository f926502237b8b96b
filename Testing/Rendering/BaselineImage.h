// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_BaselineImage_h
#define tetralux_BaselineImage_h

#include "vtkType.h"

#include <gtest/gtest.h>

#include <string>

class vtkRenderWindow;

namespace tetralux
{

/// How far a picture may be from its baseline. Each test gives its own, with the reason.
struct ImageTolerance
{
  int Channel = 0;      ///< difference in a colour channel, 0..255, up to which a pixel is equal
  vtkIdType Pixels = 0; ///< number of pixels that may be unequal
};

/// Renders the window and compares the picture with Testing/Baseline/NAME.png.
///
/// Where they differ, or there is no such baseline, NAME.png and NAME-difference.png are written to
/// Testing/Output of the build tree, and the message says where: a picture that was looked at and
/// found right becomes the baseline by copying it.
testing::AssertionResult MatchesBaseline(
  vtkRenderWindow* window, const std::string& name, ImageTolerance tolerance);

} // namespace tetralux

#endif
