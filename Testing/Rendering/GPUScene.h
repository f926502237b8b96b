// SPDX-License-Identifier: BSD-3-Clause
#ifndef GPUScene_h
#define GPUScene_h

#include "RayCastScene.h"
#include "Statistics.h"

#include "Generate/GeneratedMeshes.h"

#include "vtkImageData.h"
#include "vtkTetrahedraGPURayCastMapper.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

// Of a channel (relative, where light adds up beyond 1) and, in sizes of the box, of a distance,
// between both mappers: each has its own roundings.
inline constexpr double ColorTolerance = 5e-5;
inline constexpr double DepthTolerance = 1e-5;

// A scene with both mappers; that on the graphics card draws.
class GPUScene : public RayCastScene
{
public:
  template <class... ArgumentsT>
  explicit GPUScene(const ArgumentsT&... arguments)
    : RayCastScene(arguments...)
  {
    this->Use(this->GPUMapper);
  }

  void SetMesh(tetralux::TetrahedralMesh mesh)
  {
    this->Mesh = std::move(mesh);
    this->Scalars = MakeField(this->Mesh, { -1, -1, -1 }, 2);
    this->Grid = MakeGrid(this->Mesh, this->Scalars);
    this->Use(this->GPUMapper);
  }

  std::string GetStatistic(const std::string& name) const
  {
    return ::GetStatistic(this->GetMapper(), name);
  }

  struct Picture
  {
    std::vector<float> Colors;
    std::vector<float> Depths;
  };

  Picture Render()
  {
    this->Window->Render();
    const vtkIdType pixels = this->GetMapper()->GetOutputImage()->GetNumberOfPoints();
    if (pixels == 0)
    {
      return {};
    }
    return { { this->GetColors(), this->GetColors() + 4 * pixels },
      { this->GetDepths(), this->GetDepths() + pixels } };
  }

  Picture RenderByProcessor()
  {
    this->Mapper->SetBlendMode(this->GPUMapper->GetBlendMode());
    this->Mapper->SetMaximumError(this->GPUMapper->GetMaximumError());
    this->Mapper->SetScalarMode(this->GPUMapper->GetScalarMode());
    this->Mapper->SelectScalarArray(this->GPUMapper->GetArrayName());
    this->Mapper->SetIntegration(this->GPUMapper->GetIntegration());
    this->Mapper->SetTableScalarSize(this->GPUMapper->GetTableScalarSize());
    this->Mapper->SetTableLengthSize(this->GPUMapper->GetTableLengthSize());
    this->Mapper->SetTableLengthScale(this->GPUMapper->GetTableLengthScale());
    this->Mapper->SetTableScalarAxis(this->GPUMapper->GetTableScalarAxis());
    this->Mapper->SetSmoothShading(this->GPUMapper->GetSmoothShading());
    this->Mapper->SetPrecisionToDouble();
    this->Use(this->Mapper);
    Picture picture = this->Render();
    this->Use(this->GPUMapper);
    return picture;
  }

  // Both pictures are the same, but for a few pixels, which may hit or miss a silhouette or a step.
  void ExpectProcessorsPicture(std::size_t exceptions = 0)
  {
    const Picture expected = this->RenderByProcessor();
    const Picture picture = this->Render();
    ASSERT_EQ(picture.Colors.size(), expected.Colors.size());
    std::size_t covered = 0;
    std::size_t wrong = 0;
    std::size_t wrongDepths = 0;
    double largest = 0;
    for (std::size_t pixel = 0; pixel < picture.Depths.size(); ++pixel)
    {
      covered += expected.Depths[pixel] != -1;
      double difference = 0;
      for (std::size_t c = 4 * pixel; c < 4 * pixel + 4; ++c)
      {
        const double value = expected.Colors[c];
        difference =
          std::max(difference, std::abs(picture.Colors[c] - value) / std::max(1., std::abs(value)));
      }
      wrong += !(difference <= ColorTolerance);
      largest = std::max(largest, difference);
      wrongDepths +=
        !(std::abs(picture.Depths[pixel] - expected.Depths[pixel]) <= DepthTolerance * this->Size);
    }
    EXPECT_GT(covered, picture.Depths.size() / 20);
    EXPECT_LE(wrong, exceptions) << "largest difference " << largest;
    EXPECT_LE(wrongDepths, exceptions);
  }

  vtkNew<vtkTetrahedraGPURayCastMapper> GPUMapper;
};

inline tetralux::TetrahedralMesh MakePipe()
{
  return tetralux::GenerateMesh(
    "cylinder-with-hole", { { "across", 2 }, { "around", 20 }, { "along", 6 }, { "hole", 0.5 } })
    .Mesh;
}

inline void ShowPipe(GPUScene& scene)
{
  scene.SetMesh(MakePipe());
  scene.SetCamera({ 2.5, -3.2, 2.4 }, { 0, 0, 0.9 }, { 0, 0, 1 }, 0.1, 20);
}

#endif
