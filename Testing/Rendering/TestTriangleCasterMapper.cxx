// SPDX-License-Identifier: BSD-3-Clause
// The pictures of the mapper of image data: where the image is, what its values are, what limits
// it; beside those of VTK's mapper. The caster itself has tests of its own.
#include "ImageScene.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkTetrahedraRayCastMapper.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace
{

/// Of a channel: scalars and places in single precision, and rays that end early by 5e-5.
constexpr double Rounding = 1e-4;

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();

/// Looks along -z with parallel rays.
void LookAlongZ(ImageScene& scene)
{
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(10);
  camera->SetPosition(6.5, 5, 30);
  camera->SetFocalPoint(6.5, 5, 4);
  camera->SetViewUp(0, 1, 0);
  camera->SetClippingRange(1, 100);
}

/// Red, green, blue and opacity in the middle of a picture.
std::array<double, 4> GetMiddle(const std::vector<float>& picture, int width, int height)
{
  const std::size_t pixel = 4 * (static_cast<std::size_t>(height / 2) * width + width / 2);
  return { picture[pixel], picture[pixel + 1], picture[pixel + 2], picture[pixel + 3] };
}

/// Opacity of a length of scalar opacity a over a unit distance of 2, as the scene has it.
double GetPower(double a, double length) { return 1 - std::pow(1 - a, length / 2); }

TEST(TriangleCasterMapper, ConstantVolumesAreExact)
{
  ImageScene scene(48, 36);
  LookAlongZ(scene);
  scene.Mapper->SetInputData(MakeConstantImage(60)); // opacity 0.3, colour between two nodes
  scene.Mapper->SetMaximumError(0);
  const std::array<double, 3> color = { 0.2 + 0.8 / 3, 0.9 - 0.7 / 3, 0.5 - 0.5 / 3 };
  const auto expect = [&](double opacity, double depth, const char* name)
  {
    SCOPED_TRACE(name);
    const std::array<double, 4> middle = GetMiddle(scene.Render(), 48, 36);
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(middle[c], opacity * color[c], 1e-6);
    }
    EXPECT_NEAR(middle[3], opacity, 1e-6);
    EXPECT_NEAR(scene.GetDepths()[18 * 48 + 24], depth, 1e-4);
  };
  expect(GetPower(0.3, 8), 22, "power");
  scene.Mapper->SetSampleDistance(0.37);
  expect(GetPower(0.3, 8), 22, "another distance");
  scene.Mapper->SetOpacityModelToAttenuation();
  expect(1 - std::exp(-0.3 * 8 / 2), 22, "attenuation");
  scene.Mapper->SetOpacityModelToPower();
  scene.Volume->SetScale(1, 1, 0.5);
  expect(GetPower(0.3, 4), 26, "lengths are of the world");
  scene.Volume->SetScale(1, 1, 1);
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(0, 0, 6);
  plane->SetNormal(0, 0, -1);
  scene.Mapper->AddClippingPlane(plane);
  expect(GetPower(0.3, 6), 24, "clipped");
  scene.Mapper->RemoveAllClippingPlanes();
  scene.Mapper->CroppingOn();
  scene.Mapper->SetCroppingRegionPlanes(-1, 100, -1, 100, 3, 5);
  expect(GetPower(0.3, 2), 25, "cropped");
  scene.Mapper->SetCroppingRegionFlags(0x400010); // in front of and behind the middle
  expect(GetPower(0.3, 6), 22, "in two parts");
}

// What differs: VTK's mapper places its samples by where a ray enters, counts the whole distance
// for the first and the last one, and reads opacities and colours from tables. So both are compared
// where slices are near to each other: at a distance of 0.1 the largest difference is 8 steps of
// 255, at 0.5 it is 36.
TEST(TriangleCasterMapper, PictureIsThatOfVTK)
{
  constexpr double Distance = 0.02;
  constexpr int Tolerance = 3; // of 255 steps: both pictures are rounded, and a table is
  for (const bool parallel : { false, true })
  {
    ImageScene scene;
    scene.Renderer->GetActiveCamera()->SetParallelProjection(parallel);
    scene.Renderer->GetActiveCamera()->SetParallelScale(10);
    scene.Mapper->SetSampleDistance(Distance);
    scene.Window->Render();
    const std::vector<int> picture = scene.Grab();
    EXPECT_EQ(FindShareAbove(picture, GrabOfVTK(scene), Tolerance), 0) << parallel;
  }
}

// With the same optical model both approach the same integral. What differs: tetrahedra are linear
// where voxels are trilinear.
TEST(TriangleCasterMapper, PictureIsThatOfTetrahedra)
{
  constexpr double Tolerance = 0.06; // of a channel: by the interpolation in voxels
  ImageScene scene;
  scene.Mapper->SetOpacityModelToAttenuation();
  const std::vector<float> picture = scene.Render();
  vtkNew<vtkTetrahedraRayCastMapper> other;
  other->SetInputData(MakeImage());
  scene.Volume->SetMapper(other);
  scene.Window->Render();
  auto* colors =
    vtkFloatArray::SafeDownCast(other->GetOutputImage()->GetPointData()->GetArray("RGBA"));
  const std::vector<float> expected(
    colors->GetPointer(0), colors->GetPointer(0) + colors->GetNumberOfValues());
  EXPECT_LE(FindDifference(picture, expected), Tolerance);
}

/// A field with the same gradient everywhere.
vtkSmartPointer<vtkImageData> MakeRamp(double x, double y, double z)
{
  vtkSmartPointer<vtkImageData> image = MakeImage();
  for (vtkIdType p = 0; p < image->GetNumberOfPoints(); ++p)
  {
    const double* point = image->GetPoint(p);
    image->GetPointData()->GetScalars()->SetTuple1(
      p, 50 + x * (point[0] - 6.5) + y * (point[1] - 5) + z * (point[2] - 4));
  }
  return image;
}

// Where all normals are the same, a distant light makes all colours darker by the same share.
TEST(TriangleCasterMapper, LightsShineBySlopes)
{
  ImageScene scene(48, 36);
  LookAlongZ(scene);
  scene.Mapper->SetInputData(MakeRamp(3, 0, 4)); // 53 degrees from the viewer
  const std::vector<float> unlit = scene.Render();
  vtkVolumeProperty* property = scene.Volume->GetProperty();
  property->ShadeOn();
  property->SetAmbient(0.2);
  property->SetDiffuse(0.7);
  property->SetSpecular(0);
  const auto expect = [&](double share, const char* name)
  {
    std::vector<float> expected = unlit;
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      expected[i] *= static_cast<float>(i % 4 == 3 ? 1 : share);
    }
    EXPECT_LE(FindDifference(scene.Render(), expected), Rounding) << name;
  };
  expect(0.2 + 0.7 * 0.8, "with the ambient light of the renderer");
  scene.Renderer->SetAmbient(0, 0, 0);
  expect(0.7 * 0.8, "the headlight has none");
}

TEST(TriangleCasterMapper, GradientsWeightOpacities)
{
  ImageScene scene(48, 36);
  LookAlongZ(scene);
  scene.Mapper->SetMaximumError(0);
  scene.Mapper->SetInputData(MakeRamp(3, 4, 0));
  scene.Opacity->RemoveAllPoints();
  scene.Opacity->AddPoint(0, 0.4);
  vtkNew<vtkPiecewiseFunction> gradients;
  gradients->AddPoint(0, 0);
  gradients->AddPoint(10, 1);
  scene.Volume->GetProperty()->SetGradientOpacity(gradients);
  const auto expect = [&](double opacity)
  { EXPECT_NEAR(GetMiddle(scene.Render(), 48, 36)[3], GetPower(opacity, 8), 1e-5); };
  expect(0.4 * 0.5);
  scene.Mapper->SetGradientNormToSum();
  expect(0.4 * 0.7);
  gradients->AddPoint(6, 1);
  expect(0.4);
  scene.Mapper->SetGradientNormToEuclidean();
  expect(0.4 * 5 / 6);
  // Twice as large in all directions, which is no other function.
  scene.Volume->SetScale(2, 2, 2);
  EXPECT_NEAR(GetMiddle(scene.Render(), 48, 36)[3], GetPower(0.4 * 5 / 6, 16), 1e-5);
  scene.Volume->SetScale(1, 1, 1);
  scene.Volume->GetProperty()->DisableGradientOpacityOn();
  expect(0.4);
}

// Slices that are far apart miss what is between them, but not with a table.
TEST(TriangleCasterMapper, PreIntegratedSlabsMissNothing)
{
  constexpr double TexelError = 0.02; // of a table of 256 x 256, by a function as thin as 16 texels
  ImageScene scene(48, 36);
  LookAlongZ(scene);
  scene.Mapper->SetInputData(MakeRamp(0, 0, 8)); // linear along rays, as slabs take it to be
  scene.Opacity->RemoveAllPoints();
  for (const auto& [scalar, opacity] :
    std::vector<std::pair<double, double>>{ { 58, 0 }, { 59, 0.9 }, { 61, 0.9 }, { 62, 0 } })
  {
    scene.Opacity->AddPoint(scalar, opacity);
  }
  scene.Mapper->SetSampleDistance(0.005);
  const std::vector<float> exact = scene.Render();
  scene.Mapper->SetSampleDistance(1);
  EXPECT_GT(FindDifference(scene.Render(), exact), 10 * TexelError);
  scene.Mapper->PreIntegrationOn();
  EXPECT_LE(FindDifference(scene.Render(), exact), TexelError);
  EXPECT_EQ(scene.Get("pre_integration"), "true");
}

// Half of the spacing, and less for so few points, as VTK's mappers say.
TEST(TriangleCasterMapper, SampleDistanceFollowsTheSpacing)
{
  ImageScene scene;
  scene.Mapper->SetSampleDistance(0);
  scene.Window->Render();
  const double cells = std::cbrt(13. * 10 * 8);
  const double expected = 0.5 * (0.01 + 0.99 * cells / 100);
  EXPECT_NEAR(std::stod(scene.Get("distance")), expected, 1e-3);
  scene.Volume->SetScale(1, 1, 4);
  scene.Window->Render();
  EXPECT_NEAR(std::stod(scene.Get("distance")), 2 * expected, 2e-3);
  scene.Mapper->SetSampleDistance(0.7);
  scene.Window->Render();
  EXPECT_EQ(scene.Get("distance"), "0.7");
}

TEST(TriangleCasterMapper, InteractionsHaveFewerSlices)
{
  ImageScene scene;
  const auto getDistance = [&](double rate)
  {
    scene.Window->SetDesiredUpdateRate(rate);
    scene.Window->Render();
    return scene.Get("distance");
  };
  EXPECT_EQ(getDistance(30), "0.5"); // without automatic adjustment
  scene.Mapper->AutoAdjustSampleDistancesOn();
  EXPECT_EQ(getDistance(30), "1.0");
  EXPECT_EQ(getDistance(1e-4), "0.5");
  scene.Mapper->SetInteractiveSampleDistance(1.5);
  EXPECT_EQ(getDistance(30), "1.5");
  EXPECT_EQ(getDistance(1e-4), "0.5");
}

// What image data say of their place is what a matrix of the volume says.
TEST(TriangleCasterMapper, PlacesOfImages)
{
  ImageScene scene;
  const double origin[3] = { 1, -2, 0.5 };
  const double spacing[3] = { 1.2, 0.9, 1.4 };
  const double angle = vtkMath::RadiansFromDegrees(25.);
  const double direction[9] = { std::cos(angle), -std::sin(angle), 0, std::sin(angle),
    std::cos(angle), 0, 0, 0, 1 };
  const int first[3] = { -3, 5, 2 };

  vtkSmartPointer<vtkImageData> image = MakeImage();
  image->SetExtent(first[0], first[0] + ImageSize[0] - 1, first[1], first[1] + ImageSize[1] - 1,
    first[2], first[2] + ImageSize[2] - 1);
  image->SetOrigin(origin);
  image->SetSpacing(spacing);
  image->SetDirectionMatrix(direction);
  scene.Mapper->SetInputData(image);
  scene.Renderer->ResetCamera();
  const std::vector<float> picture = scene.Render();

  vtkNew<vtkMatrix4x4> matrix;
  for (int a = 0; a < 3; ++a)
  {
    double place = origin[a];
    for (int b = 0; b < 3; ++b)
    {
      matrix->SetElement(a, b, direction[3 * a + b] * spacing[b]);
      place += matrix->GetElement(a, b) * first[b];
    }
    matrix->SetElement(a, 3, place);
  }
  scene.Mapper->SetInputData(MakeImage());
  scene.Volume->SetUserMatrix(matrix);
  EXPECT_LE(FindDifference(scene.Render(), picture), Rounding);
}

// An image whose points are numbered from the other end of an axis.
TEST(TriangleCasterMapper, TurnedAxes)
{
  ImageScene scene;
  scene.Mapper->CroppingOn();
  scene.Mapper->SetCroppingRegionPlanes(3, 8, 2, 7, 1.5, 5);
  const int flags[] = { 0x2000, 0x2ebfeba, 0x0417410, 0x0000421 };
  for (const int mirrored : { -1, 0, 1, 2 })
  {
    vtkSmartPointer<vtkImageData> image = MakeImage();
    if (mirrored >= 0)
    {
      vtkDataArray* values = image->GetPointData()->GetScalars();
      vtkSmartPointer<vtkImageData> source = MakeImage();
      for (vtkIdType p = 0; p < image->GetNumberOfPoints(); ++p)
      {
        int ijk[3] = { static_cast<int>(p % ImageSize[0]),
          static_cast<int>(p / ImageSize[0] % ImageSize[1]),
          static_cast<int>(p / (static_cast<vtkIdType>(ImageSize[0]) * ImageSize[1])) };
        ijk[mirrored] = ImageSize[mirrored] - 1 - ijk[mirrored];
        values->SetTuple1(p, source->GetScalarComponentAsDouble(ijk[0], ijk[1], ijk[2], 0));
      }
      double origin[3] = { 0, 0, 0 };
      origin[mirrored] = ImageSize[mirrored] - 1;
      double direction[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
      direction[4 * mirrored] = -1;
      image->SetOrigin(origin);
      image->SetDirectionMatrix(direction);
    }
    for (const int flag : flags)
    {
      scene.Mapper->SetCroppingRegionFlags(flag);
      scene.Mapper->SetInputData(MakeImage());
      const std::vector<float> expected = scene.Render();
      scene.Mapper->SetInputData(image);
      EXPECT_LE(FindDifference(scene.Render(), expected), Rounding) << mirrored << " " << flag;
    }
  }
}

class TypesOfScalars : public testing::TestWithParam<int>
{
};

TEST_P(TypesOfScalars, GiveTheSamePicture)
{
  ImageScene scene;
  const std::vector<float> expected = scene.Render();
  const vtkSmartPointer<vtkImageData> image = MakeImage(GetParam());
  scene.Mapper->SetInputData(image);
  EXPECT_LE(FindDifference(scene.Render(), expected), Rounding);
  const int bytes = image->GetPointData()->GetScalars()->GetDataTypeSize();
  const bool inPlace = GetParam() == VTK_FLOAT || bytes <= 2;
  EXPECT_EQ(scene.Get("copied_bytes"),
    inPlace ? "0" : std::to_string(sizeof(float) * image->GetNumberOfPoints()));

  // One component of three.
  vtkDataArray* values = image->GetPointData()->GetScalars();
  const auto three = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(GetParam()));
  three->SetNumberOfComponents(3);
  three->SetNumberOfTuples(values->GetNumberOfTuples());
  for (vtkIdType p = 0; p < values->GetNumberOfTuples(); ++p)
  {
    three->SetTuple3(p, 100 - values->GetTuple1(p), p % 100, values->GetTuple1(p));
  }
  image->GetPointData()->SetScalars(three);
  scene.Mapper->SetVectorModeToComponent();
  scene.Mapper->SetVectorComponent(2);
  EXPECT_LE(FindDifference(scene.Render(), expected), Rounding);
}

INSTANTIATE_TEST_SUITE_P(TriangleCasterMapper, TypesOfScalars,
  testing::Values(VTK_CHAR, VTK_SIGNED_CHAR, VTK_UNSIGNED_CHAR, VTK_SHORT, VTK_UNSIGNED_SHORT,
    VTK_INT, VTK_UNSIGNED_INT, VTK_LONG, VTK_UNSIGNED_LONG, VTK_LONG_LONG, VTK_ID_TYPE, VTK_FLOAT,
    VTK_DOUBLE));

TEST(TriangleCasterMapper, MagnitudesAreOfAllComponents)
{
  ImageScene scene;
  const std::vector<float> expected = scene.Render();
  const vtkSmartPointer<vtkImageData> image = MakeImage(VTK_SHORT);
  vtkDataArray* values = image->GetPointData()->GetScalars();
  vtkNew<vtkDoubleArray> vectors;
  vectors->SetNumberOfComponents(2);
  for (vtkIdType p = 0; p < values->GetNumberOfTuples(); ++p)
  {
    vectors->InsertNextTuple2(0.6 * values->GetTuple1(p), -0.8 * values->GetTuple1(p));
  }
  image->GetPointData()->SetScalars(vectors);
  scene.Mapper->SetInputData(image);
  scene.Mapper->SetVectorModeToMagnitude();
  EXPECT_LE(FindDifference(scene.Render(), expected), Rounding);
}

// Components that are not one after the other in memory.
TEST(TriangleCasterMapper, OtherLayoutsOfMemory)
{
  ImageScene scene;
  const std::vector<float> expected = scene.Render();
  const vtkSmartPointer<vtkImageData> image = MakeImage();
  vtkDataArray* values = image->GetPointData()->GetScalars();
  vtkNew<vtkSOADataArrayTemplate<float>> parts;
  parts->SetNumberOfComponents(2);
  parts->SetNumberOfTuples(values->GetNumberOfTuples());
  for (vtkIdType p = 0; p < values->GetNumberOfTuples(); ++p)
  {
    parts->SetComponent(p, 0, values->GetTuple1(p));
    parts->SetComponent(p, 1, 100);
  }
  image->GetPointData()->SetScalars(parts);
  scene.Mapper->SetInputData(image);
  scene.Mapper->SetVectorModeToComponent();
  EXPECT_LE(FindDifference(scene.Render(), expected), Rounding);
}

// Doubles that differ by less than a float of their size can tell.
TEST(TriangleCasterMapper, SmallDifferencesOfLargeNumbers)
{
  ImageScene scene;
  const std::vector<float> expected = scene.Render();
  constexpr double Offset = 1e9;
  constexpr double Scale = 1e-4;
  const vtkSmartPointer<vtkImageData> image = MakeImage(VTK_DOUBLE);
  vtkDataArray* values = image->GetPointData()->GetScalars();
  for (vtkIdType p = 0; p < values->GetNumberOfTuples(); ++p)
  {
    values->SetTuple1(p, Offset + Scale * values->GetTuple1(p));
  }
  const auto move = [](auto* function, int size, const auto& add)
  {
    std::vector<std::array<double, 6>> nodes(size);
    for (int i = 0; i < size; ++i)
    {
      function->GetNodeValue(i, nodes[i].data());
    }
    function->RemoveAllPoints();
    for (const std::array<double, 6>& node : nodes)
    {
      add(Offset + Scale * node[0], node);
    }
  };
  move(scene.Opacity.Get(), scene.Opacity->GetSize(),
    [&](double x, const auto& node) { scene.Opacity->AddPoint(x, node[1]); });
  move(scene.Color.Get(), scene.Color->GetSize(),
    [&](double x, const auto& node) { scene.Color->AddRGBPoint(x, node[1], node[2], node[3]); });
  scene.Mapper->SetInputData(image);
  EXPECT_LE(FindDifference(scene.Render(), expected), Rounding);
}

// The largest and the smallest numbers there are.
TEST(TriangleCasterMapper, ExtremeRanges)
{
  ImageScene scene;
  const std::vector<float> expected = scene.Render();
  const std::array<double, 4> middle = GetMiddle(expected, 96, 72);
  EXPECT_GT(middle[3], 0.2);
  for (const double scale : { 1e306, 1e-300 })
  {
    const vtkSmartPointer<vtkImageData> image = MakeImage(VTK_DOUBLE);
    vtkDataArray* values = image->GetPointData()->GetScalars();
    for (vtkIdType p = 0; p < values->GetNumberOfTuples(); ++p)
    {
      values->SetTuple1(p, scale * (values->GetTuple1(p) - 50));
    }
    scene.Opacity->RemoveAllPoints();
    scene.Opacity->AddPoint(-20 * scale, 0);
    scene.Opacity->AddPoint(10 * scale, 0.3);
    scene.Opacity->AddPoint(50 * scale, 0.6);
    scene.Color->RemoveAllPoints();
    scene.Color->AddRGBPoint(-50 * scale, 0.1, 0.2, 0.9);
    scene.Color->AddRGBPoint(-10 * scale, 0.2, 0.9, 0.5);
    scene.Color->AddRGBPoint(50 * scale, 1, 0.2, 0);
    scene.Mapper->SetInputData(image);
    EXPECT_LE(FindDifference(scene.Render(), expected), Rounding) << scale;
  }
}

// Cells around a value that is no number are empty, whatever the type.
TEST(TriangleCasterMapper, ValuesThatAreNoNumbers)
{
  const vtkIdType point = 4 + ImageSize[0] * (5 + ImageSize[1] * 7);
  ImageScene scene(48, 36);
  LookAlongZ(scene);
  const std::vector<float> whole = scene.Render();
  std::vector<float> expected;
  for (const int type : { VTK_FLOAT, VTK_DOUBLE })
  {
    for (const double value : { NaN, Infinity, -Infinity })
    {
      const vtkSmartPointer<vtkImageData> image = MakeImage(type);
      image->GetPointData()->GetScalars()->SetTuple1(point, value);
      scene.Mapper->SetInputData(image);
      const std::vector<float> picture = scene.Render();
      EXPECT_TRUE(std::all_of(picture.begin(), picture.end(),
        [](float channel) { return std::isfinite(channel) && channel >= 0; }));
      if (expected.empty())
      {
        expected = picture;
        EXPECT_GT(FindDifference(picture, whole), 0.02);
      }
      EXPECT_LE(FindDifference(picture, expected), Rounding) << type << " " << value;
    }
  }
}

TEST(TriangleCasterMapper, GeometryHidesWhatIsBehind)
{
  ImageScene scene(48, 36);
  LookAlongZ(scene);
  scene.Mapper->SetInputData(MakeConstantImage(60));
  const double whole = GetMiddle(scene.Render(), 48, 36)[3];
  EXPECT_NEAR(whole, GetPower(0.3, 8), 1e-4);
  for (const auto& [z, length] :
    std::vector<std::pair<double, double>>{ { 11, 0 }, { 4, 3 }, { -3, 8 } })
  {
    ImageScene covered(48, 36);
    LookAlongZ(covered);
    covered.Mapper->SetInputData(MakeConstantImage(60));
    covered.AddSphere(6.5, 5, z, 1);
    // A sphere of triangles is a little smaller.
    EXPECT_NEAR(GetMiddle(covered.Render(), 48, 36)[3], GetPower(0.3, length), 0.02) << z;
    covered.Mapper->IntermixIntersectingGeometryOff();
    EXPECT_NEAR(GetMiddle(covered.Render(), 48, 36)[3], whole, 1e-6) << z;
  }
}

// Shells are as far apart along all rays, planes are not; both are near to the same integral.
TEST(TriangleCasterMapper, SliceShapes)
{
  ImageScene scene;
  scene.Renderer->GetActiveCamera()->SetViewAngle(60);
  scene.Mapper->SetSampleDistance(0.1);
  const std::vector<float> planes = scene.Render();
  EXPECT_EQ(scene.Get("shape"), "\"planes\"");
  scene.Mapper->SetSliceShapeToShells();
  const std::vector<float> shells = scene.Render();
  EXPECT_EQ(scene.Get("shape"), "\"shells\"");
  EXPECT_LE(FindDifference(planes, shells), 0.005);
  EXPECT_NE(planes, shells);
  scene.Mapper->SetSliceShapeToPlanes();
  scene.Mapper->CorrectOpacityOff();
  EXPECT_GT(FindDifference(scene.Render(), planes), 0.005);
}

// What saves time changes nothing that MaximumError does not allow.
TEST(TriangleCasterMapper, ShortcutsKeepThePicture)
{
  ImageScene scene;
  scene.Volume->GetProperty()->SetScalarOpacityUnitDistance(0.2);
  scene.Mapper->EndTrianglesOff();
  scene.Mapper->SkipPixelsOff();
  scene.Mapper->SkipEmptySpaceOff();
  const std::vector<float> expected = scene.Render();
  const std::string samples = scene.Get("samples");
  for (const int shortcut : { 1, 2, 4, 7 })
  {
    scene.Mapper->SetEndTriangles(shortcut & 1);
    scene.Mapper->SetSkipPixels(shortcut >> 1 & 1);
    scene.Mapper->SetSkipEmptySpace(shortcut >> 2 & 1);
    EXPECT_LE(FindDifference(scene.Render(), expected), Rounding) << shortcut;
    if ((shortcut & 3) != 0)
    {
      EXPECT_LT(std::stoll(scene.Get("samples")), std::stoll(samples)) << shortcut;
    }
  }
  for (const int size : { 4, 13, 64 })
  {
    scene.Mapper->SetTileSize(size);
    scene.Mapper->CastTrianglesOn();
    EXPECT_LE(FindDifference(scene.Render(), expected), Rounding) << size;
    scene.Mapper->CastTrianglesOff();
    EXPECT_LE(FindDifference(scene.Render(), expected), Rounding) << size;
  }
}

TEST(TriangleCasterMapper, EmptySpaceIsSkipped)
{
  ImageScene scene;
  const vtkSmartPointer<vtkImageData> image = MakeConstantImage(60);
  for (vtkIdType p = 0; p < image->GetNumberOfPoints(); ++p)
  {
    if (p % ImageSize[0] > 2)
    {
      image->GetPointData()->GetScalars()->SetTuple1(p, 0);
    }
  }
  scene.Mapper->SetInputData(image);
  scene.Mapper->SkipEmptySpaceOff();
  const std::vector<float> expected = scene.Render();
  const std::int64_t all = std::stoll(scene.Get("samples"));
  scene.Mapper->SkipEmptySpaceOn();
  EXPECT_LE(FindDifference(scene.Render(), expected), Rounding);
  EXPECT_LT(std::stoll(scene.Get("samples")), 0.8 * static_cast<double>(all));
}

TEST(TriangleCasterMapper, CamerasInsideSeeWhatIsInFront)
{
  ImageScene scene(48, 36);
  scene.Mapper->SetInputData(MakeConstantImage(60));
  scene.Mapper->SetMaximumError(0);
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  camera->SetPosition(6.5, 5, 5);
  camera->SetFocalPoint(6.5, 5, 0);
  camera->SetViewUp(0, 1, 0);
  camera->SetClippingRange(0.001, 100);
  // Half a pixel beside the middle.
  EXPECT_NEAR(GetMiddle(scene.Render(), 48, 36)[3], GetPower(0.3, 5 - 0.001), 1e-4);
  EXPECT_NEAR(scene.GetDepths()[18 * 48 + 24], 0.001, 1e-5);
}

} // namespace
