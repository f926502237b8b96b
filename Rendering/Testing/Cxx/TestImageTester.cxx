// SPDX-License-Identifier: BSD-3-Clause
// The comparison itself: it passes on the right picture and fails on a wrong one.
#include "ImageTester.h"

#include "vtkActor.h"
#include "vtkHeadlessRenderWindow.h"
#include "vtkNew.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

namespace
{

// In whole pixels. Flat shading in pure colours: every correct OpenGL paints the same pixels, but
// for those whose centre the rim of the sphere passes within its rounding.
constexpr double RimThreshold = 1;

// A red sphere on blue.
class SphereScene
{
public:
  SphereScene(int argc, char* argv[])
  {
    this->Tester->AddArguments(argc, argv);
    this->Tester->SetRenderWindow(this->Window);
    vtkNew<vtkSphereSource> sphere;
    sphere->SetThetaResolution(64);
    sphere->SetPhiResolution(64);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(sphere->GetOutputPort());
    this->Actor->SetMapper(mapper);
    this->Actor->GetProperty()->LightingOff();
    this->Actor->GetProperty()->SetColor(1, 0, 0);
    vtkNew<vtkRenderer> renderer;
    renderer->AddActor(this->Actor);
    renderer->SetBackground(0, 0, 1);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(200, 150);
    this->Window->AddRenderer(renderer);
    renderer->ResetCamera();
  }

  // Counts it as a failure if the comparison says otherwise. Its messages say "Failed Image Test",
  // which is a failure of this test where it is seen.
  void Expect(int expected, const std::string& what)
  {
    std::ostringstream messages;
    if (this->Tester->RegressionTest(RimThreshold, messages) != expected)
    {
      std::cerr << what << ": the comparison should have "
                << (expected == vtkTesting::PASSED ? "passed" : "failed") << "\n";
      this->Passed = false;
    }
  }

  // Fails, and leaves the pictures for who looks into it.
  void ExpectMismatch(const std::string& what, bool withDifference)
  {
    const std::string stem = std::string(this->Tester->GetTempDirectory()) + "/Sphere";
    const std::string picture = stem + ".png";
    const std::string difference = stem + ".diff.png";
    std::remove(picture.c_str());
    std::remove(difference.c_str());
    this->Expect(vtkTesting::FAILED, what);
    if (!std::ifstream(picture) || std::ifstream(difference).good() != withDifference)
    {
      std::cerr << what << ": wrong files in " << this->Tester->GetTempDirectory() << "\n";
      this->Passed = false;
    }
  }

  vtkNew<ImageTester> Tester;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkHeadlessRenderWindow> Window;
  bool Passed = true;
};

} // namespace

int TestImageTester(int argc, char* argv[])
{
  SphereScene scene(argc, argv);
  scene.Expect(vtkTesting::PASSED, "the right picture");

  scene.Actor->GetProperty()->SetColor(250.0 / 255, 0, 0); // vtkTesting alone lets it pass
  scene.ExpectMismatch("a darker red", true);
  scene.Actor->GetProperty()->SetColor(0.5, 0, 0);
  scene.ExpectMismatch("a dark red", true);
  scene.Actor->GetProperty()->SetColor(1, 0, 0);

  scene.Actor->SetPosition(0.01, 0, 0); // one pixel: vtkTesting alone lets it pass
  scene.ExpectMismatch("a shift", true);
  scene.Actor->SetPosition(0, 0, 0);

  scene.Window->SetSize(150, 200);
  scene.ExpectMismatch("another size", false);
  return scene.Passed ? EXIT_SUCCESS : EXIT_FAILURE;
}
