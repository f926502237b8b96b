// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTriangleCasterRepresentation
 * @brief   volumes of image data by the triangle caster of Tetralux
 *
 * @warning Rectilinear grids and composites of several images are refused by the mapper, with an
 * error.
 *
 * @sa vtkTriangleCasterMapper
 */
#ifndef vtkTriangleCasterRepresentation_h
#define vtkTriangleCasterRepresentation_h

#include "TetraluxRepresentationsModule.h" // For export macro
#include "vtkImageVolumeRepresentation.h"

#include <memory> // For std::unique_ptr
#include <string> // For std::string
#include <vector> // For std::vector

class vtkImplicitFunction;
class vtkTriangleCasterMapper;

class TETRALUXREPRESENTATIONS_EXPORT vtkTriangleCasterRepresentation
  : public vtkImageVolumeRepresentation
{
public:
  static vtkTriangleCasterRepresentation* New();
  vtkTypeMacro(vtkTriangleCasterRepresentation, vtkImageVolumeRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Set a property of the mapper by its name, as SetMapperProperty("MaximumError", 1e-4).
   */
  void SetMapperProperty(const char* name, double value);
  void SetMapperProperty(const char* name, double v0, double v1);
  void SetMapperProperty(const char* name, double v0, double v1, double v2);
  void SetMapperProperty(
    const char* name, double v0, double v1, double v2, double v3, double v4, double v5);
  ///@}

  /**
   * Set what is shown: what is inside of a vtkBox, or on the side that the normal of a vtkPlane
   * points away from. Default nullptr: everything.
   */
  void SetClipFunction(vtkImplicitFunction* function);

  ///@{
  /**
   * Find the unit distance with which rays through the bounds of the data, in all directions alike,
   * have a mean optical depth of 1 with the opacities of now; to be called by all processes at
   * once. 0 if there are no data, or if all are transparent.
   */
  void MeasureUnitDistance();
  double GetMeasuredUnitDistance();
  ///@}

  /**
   * Return the statistics of the last frame of this process, as JSON, see
   * vtkTriangleCasterMapper::GetStatistics. In a parallel run with "composited", the bytes that all
   * processes sent and the seconds that this one took. Images stay where they are: "distributed"
   * has no bytes.
   */
  const char* GetStatistics();

  /**
   * Set whether it is shown in views.
   */
  void SetVisibility(bool visible) override;

  int ProcessViewRequest(
    vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo) override;

protected:
  vtkTriangleCasterRepresentation();
  ~vtkTriangleCasterRepresentation() override;

  void UpdateMapperParameters() override;
  bool AddToView(vtkView* view) override;
  bool RemoveFromView(vtkView* view) override;

private:
  vtkTriangleCasterRepresentation(const vtkTriangleCasterRepresentation&) = delete;
  void operator=(const vtkTriangleCasterRepresentation&) = delete;

  void SetValues(const char* name, const std::vector<double>& values);

  class Internals;
  std::unique_ptr<Internals> Private;
};

#endif
