// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchMeasure_h
#define BenchMeasure_h

#include "Bench/BenchResults.h"
#include "Bench/BenchView.h"

class AtomicOutput;
struct BenchScene;
struct SceneOptions;

/// A scene, and how it is measured.
struct BenchRun
{
  const BenchScene& Scene;
  const SceneOptions& View; ///< size, camera, threads
  int Frames;               ///< at most
  AtomicOutput& Folder;     ///< for pictures
  vtkHeadlessRenderWindow* Window;
};

/// A setting's row and its picture, which is empty if it failed.
struct BenchMeasurement
{
  BenchRow Row;
  BenchPicture Picture;
};

/// A measurement of at least FewestFrames ends with the frame that brings it to this many seconds.
///@{
constexpr double LongestMeasurement = 1.5;
constexpr int FewestFrames = 3;
///@}

/// Renders and times one setting.
BenchMeasurement Measure(const BenchRun& run, const BenchSetting& setting);

/// Compares a setting's picture with the reference. Writes the picture and the difference.
void Compare(const BenchRun& run, const BenchPicture& reference, BenchMeasurement& measurement);

#endif
