// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchMappers_h
#define BenchMappers_h

#include "vtkSmartPointer.h"

struct BenchSetting;
class vtkAbstractVolumeMapper;

/// Makes the mapper of a setting, without input. It casts one ray a pixel unless the setting says
/// otherwise. numberOfThreads: of methods of the processor; 0: one for each core.
vtkSmartPointer<vtkAbstractVolumeMapper> MakeBenchMapper(
  const BenchSetting& setting, int numberOfThreads);

/// Throws UsageError if the mapper does not take an assignment.
void CheckSetting(const BenchSetting& setting);

#endif
