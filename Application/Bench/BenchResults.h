// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchResults_h
#define BenchResults_h

#include "Bench/BenchSetting.h"
#include "ImageComparison.h"

#include <limits>
#include <string>
#include <vector>

/// Stands for a missing number.
constexpr double NoNumber = std::numeric_limits<double>::quiet_NaN();

/// What one setting did in one scene.
struct BenchRow
{
  BenchSetting Setting;
  std::string Failure; ///< one line; if it is not empty, nothing below is set

  tetralux::ImageErrors Errors;    ///< over the pixels that either picture covers
  bool EightBit = false;           ///< the picture came from the frame buffer
  double ErrorEstimate = NoNumber; ///< the mapper's own estimate of its largest error

  double BestSeconds = NoNumber; ///< of the frames after the first
  double MedianSeconds = NoNumber;
  int Frames = 0;
  double PrepareSeconds = NoNumber; ///< the first frame, less the median of the others
  double Bytes = NoNumber;          ///< of the mapper's tables, if it tells

  bool OnFront = false; ///< see MarkFront

  double Amplification = 1;   ///< of the difference picture, a power of ten
  std::string PictureFile;    ///< in the output folder
  std::string DifferenceFile; ///< in the output folder; empty for the reference
  std::string PictureUri;     ///< a small picture for the page; empty if the page does not show it
  std::string DifferenceUri;  ///< likewise
};

/// What all settings did in one scene, the reference first.
struct BenchSceneResult
{
  std::string Name;
  std::string Description;
  int Width = 0;
  int Height = 0;
  std::vector<BenchRow> Rows;
};

#endif
