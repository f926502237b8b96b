// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchChart_h
#define BenchChart_h

#include "Bench/BenchResults.h"

#include "vtkSmartPointer.h"

class vtkImageData;

/// Largest error against time of a frame, both logarithmic: one mark for each setting, by group, a
/// line along the Pareto front, whose settings are named. An error below the axis is drawn on it.
vtkSmartPointer<vtkImageData> DrawErrorChart(const BenchSceneResult& result);

#endif
