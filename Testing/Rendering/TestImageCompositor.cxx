// SPDX-License-Identifier: BSD-3-Clause
// Pictures in memory that are composited into frame buffers: by the processor where OpenGL is
// software, and as drawn.

#include "Frame/ImageCompositor.h"
#include "Frame/PixelBlending.h"
#include "OpenGL/FloatTarget.h"
#include "OpenGLSnapshot.h"

#include "vtkHeadlessRenderWindow.h"
#include "vtkNew.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLState.h"
#include "vtkRenderer.h"
#include "vtk_glew.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

namespace
{

using tetralux::ImageCompositor;
using tetralux::MemoryPicture;
using tetralux::PixelRectangle;

constexpr int Width = 24;
constexpr int Height = 16;
constexpr int Left = 3;
constexpr int Lower = 2;
constexpr int PictureWidth = 17;
constexpr int PictureHeight = 11;
constexpr PixelRectangle Place{ Left, Lower, PictureWidth, PictureHeight };
constexpr PixelRectangle Covered{ 1, 2, 13, 7 };

/// Half of one of 255 steps, and the rounding of single precision.
constexpr double RoundedOnce = 0.5 + 1e-4;

/// Steps of 255: the drawn colour is rounded before it is blended, its product after it, and so is
/// what the processor blends.
constexpr int DrawnSteps = 2;

/// Of depths: drawn ones pass through single precision.
constexpr double DepthRounding = 1e-7;

/// A premultiplied picture with nothing beyond Covered, but for one that says so.
struct RandomPicture
{
  explicit RandomPicture(unsigned seed)
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> share(0, 1);
    this->Colors.assign(4 * PictureWidth * PictureHeight, 0);
    this->Bytes.assign(4 * PictureWidth * PictureHeight, 0);
    this->Depths.assign(PictureWidth * PictureHeight, 1);
    for (int y = Covered.Y; y < Covered.Y + Covered.Height; ++y)
    {
      for (int x = Covered.X; x < Covered.X + Covered.Width; ++x)
      {
        const int pixel = y * PictureWidth + x;
        const float alpha = share(random);
        for (int c = 0; c < 3; ++c)
        {
          this->Colors[4 * pixel + c] = alpha * share(random);
          this->Bytes[4 * pixel + c] = static_cast<std::uint8_t>(255 * share(random));
        }
        this->Colors[4 * pixel + 3] = alpha;
        this->Bytes[4 * pixel + 3] = 255;
        const float depth = share(random);
        this->Depths[pixel] = depth < 0.3f ? 1 : depth;
      }
    }
    this->Picture.Width = PictureWidth;
    this->Picture.Height = PictureHeight;
  }

  std::vector<float> Colors;
  std::vector<std::uint8_t> Bytes;
  std::vector<float> Depths;
  MemoryPicture Picture;
};

class ImageCompositorTest : public testing::Test
{
public:
  void SetUp() override
  {
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(Width, Height);
    this->Renderer->SetBackground(0.2, 0.4, 0.6);
    this->Window->AddRenderer(this->Renderer);
  }

  struct Contents
  {
    std::vector<unsigned char> Colors;
    std::vector<float> Depths;
  };

  /// What the window has after a picture was composited over a background at a depth.
  Contents Composite(const RandomPicture& picture, float depth, bool drawn)
  {
    this->Window->Render();
    this->Window->GetRenderFramebuffer()->Bind();
    this->Window->GetRenderFramebuffer()->ActivateReadBuffer(0);
    vtkOpenGLState* state = this->Window->GetState();
    glClearDepth(depth);
    state->vtkglDepthMask(GL_TRUE);
    state->vtkglClear(GL_DEPTH_BUFFER_BIT);
    glClearDepth(1);
    if (drawn) // what a stencil lets through can't be copied
    {
      state->vtkglEnable(GL_STENCIL_TEST);
    }
    EXPECT_EQ(tetralux::MemoryCompositor::CanComposite(picture.Picture), !drawn);
    const OpenGLSnapshot before = TakeOpenGLSnapshot(this->Window);
    this->Compositor.Composite(this->Window, Place, picture.Picture, Covered);
    EXPECT_EQ(FindDifferences(before, TakeOpenGLSnapshot(this->Window)), "");
    state->vtkglDisable(GL_STENCIL_TEST);
    Contents contents;
    contents.Colors.resize(4 * Width * Height);
    contents.Depths.resize(Width * Height);
    glReadPixels(0, 0, Width, Height, GL_RGBA, GL_UNSIGNED_BYTE, contents.Colors.data());
    glReadPixels(0, 0, Width, Height, GL_DEPTH_COMPONENT, GL_FLOAT, contents.Depths.data());
    return contents;
  }

  /// Both ways have the same result, and it is not that without the picture.
  void Compare(const RandomPicture& picture, float depth)
  {
    const Contents copied = this->Composite(picture, depth, false);
    const Contents drawn = this->Composite(picture, depth, true);
    int changed = 0;
    for (std::size_t k = 0; k < copied.Colors.size(); ++k)
    {
      EXPECT_LE(std::abs(copied.Colors[k] - drawn.Colors[k]), DrawnSteps) << k;
      changed += copied.Colors[k] != copied.Colors[k % 4] ? 1 : 0;
    }
    for (std::size_t k = 0; k < copied.Depths.size(); ++k)
    {
      EXPECT_NEAR(copied.Depths[k], drawn.Depths[k], DepthRounding) << k;
    }
    EXPECT_GT(changed, 0);
    EXPECT_LE(changed, 4 * Covered.Width * Covered.Height);
  }

  vtkNew<vtkHeadlessRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  ImageCompositor Compositor;
};

TEST(PixelBlending, RoundsOnce)
{
  constexpr int Count = 1000;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> share(-0.1f, 1.1f);
  std::vector<float> colors(4 * Count);
  std::generate(colors.begin(), colors.end(), [&] { return share(random); });
  std::vector<std::uint32_t> pixels(Count);
  std::generate(pixels.begin(), pixels.end(), [&] { return static_cast<std::uint32_t>(random()); });
  const std::vector<std::uint32_t> before = pixels;
  tetralux::BlendColors(colors.data(), pixels.data(), Count);
  const auto limit = [](double x) { return std::max(0., std::min(x, 1.)); };
  for (int k = 0; k < Count; ++k)
  {
    for (int c = 0; c < 4; ++c)
    {
      const double behind = before[k] >> (8 * c) & 255;
      const double exact =
        std::min(255 * limit(colors[4 * k + c]) + (1 - limit(colors[4 * k + 3])) * behind, 255.);
      EXPECT_NEAR(pixels[k] >> (8 * c) & 255, exact, RoundedOnce) << k << " " << c;
    }
  }
}

TEST(PixelBlending, LimitsSumsAboveOne)
{
  const float colors[4] = { 1, 0.9f, 0.5f, 0.1f }; // brighter than its opacity
  std::uint32_t pixel = 0xffffffff;
  tetralux::BlendColors(colors, &pixel, 1);
  EXPECT_EQ(pixel, 0xffffffff);
}

TEST(PixelBlending, KeepsTheNearerDepth)
{
  const std::vector<float> depths = { 0, 0.25f, 0.75f, 1, 2, 0x1.fffffep-1f };
  const std::uint32_t middle = 0x80000000u;
  std::vector<std::uint32_t> pixelDepths(depths.size(), middle);
  tetralux::PutDepths(depths.data(), pixelDepths.data(), static_cast<int>(depths.size()));
  EXPECT_EQ(
    pixelDepths, (std::vector<std::uint32_t>{ 0, 0x40000000u, middle, middle, middle, middle }));

  pixelDepths.assign(depths.size(), 0xffffffff);
  const std::vector<std::uint8_t> bytes(4 * depths.size(), 9);
  std::vector<std::uint32_t> pixels(depths.size(), 5);
  tetralux::PutOpaque(bytes.data(), depths.data(), pixels.data(), pixelDepths.data(),
    static_cast<int>(depths.size()));
  EXPECT_EQ(pixelDepths,
    (std::vector<std::uint32_t>{
      0, 0x40000000u, 0xc0000000u, 0xffffffffu, 0xffffffffu, 0xffffff00u }));
  const std::uint32_t nines = 0x09090909;
  EXPECT_EQ(pixels, (std::vector<std::uint32_t>{ nines, nines, nines, 5, 5, nines }));
}

TEST_F(ImageCompositorTest, CopiesAsItDraws)
{
  RandomPicture picture(1);
  picture.Picture.Colors = picture.Colors.data();
  this->Compare(picture, 1);
}

TEST_F(ImageCompositorTest, CopiesDepthsAsItDrawsThem)
{
  RandomPicture picture(2);
  picture.Picture.Colors = picture.Colors.data();
  picture.Picture.Depths = picture.Depths.data();
  this->Compare(picture, 1);
  this->Compare(picture, 0.6f);
}

TEST_F(ImageCompositorTest, CopiesWhatIsOpaqueAsItDraws)
{
  RandomPicture picture(3);
  picture.Picture.Bytes = picture.Bytes.data();
  picture.Picture.Depths = picture.Depths.data();
  this->Compare(picture, 1);
  this->Compare(picture, 0.6f);
}

TEST_F(ImageCompositorTest, KeepsThePrecisionOfAFloatFrameBuffer)
{
  this->Window->Render();
  tetralux::FloatTarget target;
  tetralux::FloatTarget::Settings settings;
  settings.Width = PictureWidth;
  settings.Height = PictureHeight;
  target.Prepare(this->Window, settings);
  RandomPicture picture(4);
  picture.Picture.Colors = picture.Colors.data();
  const std::array<float, 4> behind = { 0.3f, 0.2f, 0.7f, 1 };
  {
    const tetralux::FloatTarget::Use use(target);
    glClearBufferfv(GL_COLOR, 0, behind.data());
    this->Compositor.Composite(
      this->Window, { 0, 0, PictureWidth, PictureHeight }, picture.Picture, Covered);
  }
  std::vector<float> values(picture.Colors.size());
  target.Read(0, values);
  constexpr double SingleRounding = 1e-6;
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    const double rest = 1 - static_cast<double>(picture.Colors[4 * (k / 4) + 3]);
    EXPECT_NEAR(values[k], picture.Colors[k] + rest * behind[k % 4], SingleRounding) << k;
  }
}

} // namespace
