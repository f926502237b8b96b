// SPDX-License-Identifier: BSD-3-Clause
#ifndef VisitMapper_h
#define VisitMapper_h

#include "vtkTetrahedraVolumeMapper.h"
#include "vtkTriangleCasterMapper.h"

/// Calls a function with a mapper of this project as the class that it is: mappers of cells and of
/// image data have no base class in common that knows of pictures, statistics and errors, but the
/// same functions for them.
template <class FunctionT>
auto VisitMapper(vtkAbstractVolumeMapper* mapper, const FunctionT& function)
{
  auto* caster = vtkTriangleCasterMapper::SafeDownCast(mapper);
  return caster ? function(caster) : function(vtkTetrahedraVolumeMapper::SafeDownCast(mapper));
}

#endif
