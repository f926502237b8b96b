// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMUnitDistanceDomain
 * @brief   resets a unit distance to one with which data are neither too dense nor too thin
 *
 * A reset asks the representation for the unit distance with which rays through the bounds of the
 * data have a mean optical depth of 1, by its properties TetraluxMeasureUnitDistance and
 * TetraluxMeasuredUnitDistance. Where there are no data yet, and where all is transparent, the
 * default is that of the superclass.
 */
#ifndef vtkSMUnitDistanceDomain_h
#define vtkSMUnitDistanceDomain_h

#include "TetraluxRepresentationsModule.h" // For export macro
#include "vtkSMBoundsDomain.h"

class TETRALUXREPRESENTATIONS_EXPORT vtkSMUnitDistanceDomain : public vtkSMBoundsDomain
{
public:
  static vtkSMUnitDistanceDomain* New();
  vtkTypeMacro(vtkSMUnitDistanceDomain, vtkSMBoundsDomain);

  int SetDefaultValues(vtkSMProperty* property, bool unchecked) override;

protected:
  vtkSMUnitDistanceDomain();
  ~vtkSMUnitDistanceDomain() override;

private:
  vtkSMUnitDistanceDomain(const vtkSMUnitDistanceDomain&) = delete;
  void operator=(const vtkSMUnitDistanceDomain&) = delete;
};

#endif
