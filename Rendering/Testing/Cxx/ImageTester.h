// SPDX-License-Identifier: BSD-3-Clause
#ifndef ImageTester_h
#define ImageTester_h

#include "vtkRegressionTestImage.h"

/**
 * What vtkRegressionTestImage does, with a comparison that sees small differences too.
 *
 * vtkTesting looks for each pixel among the neighbours and their averages, and takes differences of
 * up to 16 of 255 for none. That hides a picture that is a little too bright everywhere. This class
 * asks in addition that pixels at the same place agree within ChannelTolerance.
 *
 * A threshold is in whole pixels: each pixel counts by how much its channels differ beyond the
 * tolerance, averaged over the three channels, a difference of 255 as one pixel. It holds for both
 * comparisons.
 *
 * The command line is vtkTesting's: -V the baseline, -B the folder that it is relative to, -T the
 * folder that the picture and its difference are written to if they differ, -I interactive.
 */
class ImageTester : public vtkRegressionTester
{
public:
  static ImageTester* New();
  vtkTypeMacro(ImageTester, vtkRegressionTester);

  /// In 255ths of a channel: two colours that are nearly the same may be rounded to neighbours.
  static constexpr int ChannelTolerance = 1;

  using vtkRegressionTester::RegressionTest;
  int RegressionTest(vtkAlgorithm* imageSource, double threshold, ostream& os) override;

protected:
  ImageTester() = default;
  ~ImageTester() override = default;

private:
  ImageTester(const ImageTester&) = delete;
  void operator=(const ImageTester&) = delete;
};

#endif
