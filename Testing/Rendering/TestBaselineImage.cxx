// SPDX-License-Identifier: BSD-3-Clause
// The comparison itself: it passes on the right picture and fails on a wrong one.
#include "BaselineImage.h"

#include "vtkActor.h"
#include "vtkHeadlessRenderWindow.h"
#include "vtkNew.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"

#include <cstdio>
#include <fstream>
#include <string>

namespace
{

// Flat shading in pure colours: every correct OpenGL paints the same pixels, but for those whose
// centre the rim of the sphere passes within its rounding.
constexpr tetralux::ImageTolerance Rim{ 0, 8 };

class BaselineImage : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Sphere->SetThetaResolution(64);
    this->Sphere->SetPhiResolution(64);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(this->Sphere->GetOutputPort());
    this->Actor->SetMapper(mapper);
    this->Actor->GetProperty()->LightingOff();
    this->Actor->GetProperty()->SetColor(1, 0, 0);
    this->Renderer->AddActor(this->Actor);
    this->Renderer->SetBackground(0, 0, 1);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(200, 150);
    this->Window->AddRenderer(this->Renderer);
    ASSERT_TRUE(this->Window->SupportsOpenGL());
    this->Renderer->ResetCamera();
  }

  // Fails, and leaves the pictures for who looks into it.
  void ExpectMismatch(const std::string& name, bool withDifference)
  {
    const std::string path = std::string(TETRALUX_OUTPUT_DIRECTORY) + "/" + name + ".png";
    const std::string difference =
      std::string(TETRALUX_OUTPUT_DIRECTORY) + "/" + name + "-difference.png";
    std::remove(path.c_str());
    std::remove(difference.c_str());
    EXPECT_FALSE(tetralux::MatchesBaseline(this->Window, name, Rim));
    EXPECT_TRUE(std::ifstream(path).good());
    EXPECT_EQ(std::ifstream(difference).good(), withDifference);
  }

  vtkNew<vtkSphereSource> Sphere;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkHeadlessRenderWindow> Window;
};

TEST_F(BaselineImage, MatchesTheRightPicture)
{
  EXPECT_TRUE(tetralux::MatchesBaseline(this->Window, "Sphere", Rim));
}

// One test, not three: they write the same files.
TEST_F(BaselineImage, RejectsWrongPictures)
{
  this->Actor->GetProperty()->SetColor(250.0 / 255, 0, 0);
  this->ExpectMismatch("Sphere", true);
  this->Actor->GetProperty()->SetColor(1, 0, 0);

  this->Actor->SetPosition(0.01, 0, 0); // one pixel
  this->ExpectMismatch("Sphere", true);
  this->Actor->SetPosition(0, 0, 0);

  this->Window->SetSize(150, 200);
  this->ExpectMismatch("Sphere", false);
}

TEST_F(BaselineImage, RejectsAMissingBaseline) { this->ExpectMismatch("NoSuchBaseline", false); }

} // namespace
