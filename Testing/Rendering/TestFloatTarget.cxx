// SPDX-License-Identifier: BSD-3-Clause
// Pictures on the graphics card: drawn into, read, composited, and OpenGL's state as it was.

#include "Frame/ImageCompositor.h"
#include "GlslEvaluator.h"
#include "GpuIntegral/GpuSegmentIntegral.h"
#include "OpenGL/FloatTarget.h"
#include "OpenGL/LoadedFunctions.h"
#include "OpenGLSnapshot.h"
#include "Optics/IntervalTable.h"

#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLState.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace
{

using tetralux::ChannelFormat;
using tetralux::FloatTarget;

class FloatTargetTest : public testing::Test
{
public:
  void SetUp() override
  {
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(24, 16);
    this->Renderer->SetBackground(0.2, 0.4, 0.6);
    this->Window->AddRenderer(this->Renderer);
    this->Render();
  }

  /// With the frame buffer bound that mappers find.
  void Render()
  {
    this->Window->Render();
    this->Window->GetRenderFramebuffer()->Bind();
    this->Window->GetRenderFramebuffer()->ActivateReadBuffer(0);
  }

  void Clear(const std::array<float, 4>& color)
  {
    vtkOpenGLState* state = this->Window->GetState();
    const vtkOpenGLState::ScopedglClearColor clearColor(state);
    state->vtkglClearColor(color[0], color[1], color[2], color[3]);
    state->vtkglClear(GL_COLOR_BUFFER_BIT);
  }

  std::vector<unsigned char> ReadWindow()
  {
    std::vector<unsigned char> pixels(24 * 16 * 4);
    glReadPixels(0, 0, 24, 16, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    return pixels;
  }

  vtkNew<vtkHeadlessRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  FloatTarget Target;
};

TEST_F(FloatTargetTest, RefusesMoreThanOpenGLDraws)
{
  int largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  FloatTarget::Settings settings;
  settings.Pictures = { { 1, ChannelFormat::UNorm8 } };
  for (const auto& [width, height] : { std::pair(largest + 1, 1), std::pair(1, largest + 1) })
  {
    settings.Width = width;
    settings.Height = height;
    try
    {
      this->Target.Prepare(this->Window, settings);
      ADD_FAILURE() << "no error";
    }
    catch (const std::runtime_error& error)
    {
      EXPECT_NE(
        std::string(error.what()).find("at most " + std::to_string(largest)), std::string::npos)
        << error.what();
    }
  }
}

TEST_F(FloatTargetTest, HoldsWhatIsDrawn)
{
  FloatTarget::Settings settings;
  settings.Width = 5;
  settings.Height = 3;
  settings.Pictures = { { 4, ChannelFormat::Float }, { 1, ChannelFormat::Float },
    { 4, ChannelFormat::Half }, { 4, ChannelFormat::UNorm8 } };
  settings.DepthStencil = true;
  this->Target.Prepare(this->Window, settings);
  EXPECT_EQ(this->Target.GetNumberOfBytes(), 5u * 3 * (16 + 4 + 8 + 4 + 4));
  const OpenGLSnapshot before = TakeOpenGLSnapshot(this->Window);
  {
    const FloatTarget::Use use(this->Target);
    this->Clear({ 0.1f, -2, 1e-9f, 3e8f });
  }
  EXPECT_EQ(FindDifferences(before, TakeOpenGLSnapshot(this->Window)), "");

  std::vector<float> values(5 * 3 * 4);
  this->Target.Read(0, values);
  for (std::size_t i = 0; i < values.size(); i += 4)
  {
    EXPECT_EQ(values[i], 0.1f);
    EXPECT_EQ(values[i + 1], -2);
    EXPECT_EQ(values[i + 2], 1e-9f);
    EXPECT_EQ(values[i + 3], 3e8f);
  }
  std::vector<float> single(5 * 3);
  this->Target.Read(1, single);
  EXPECT_EQ(single, std::vector<float>(5 * 3, 0.1f));
  this->Target.Read(2, values);
  EXPECT_NEAR(values[0], 0.1, 1e-4);
  this->Target.Read(3, values);
  EXPECT_NEAR(values[0], 0.1, 0.51 / 255);
  EXPECT_EQ(values[1], 0);
  EXPECT_EQ(FindDifferences(before, TakeOpenGLSnapshot(this->Window)), "");
}

TEST_F(FloatTargetTest, DrawsIntoSomeOfThePictures)
{
  FloatTarget::Settings settings;
  settings.Width = 2;
  settings.Pictures = { {}, {} };
  this->Target.Prepare(this->Window, settings);
  {
    FloatTarget::Use use(this->Target);
    this->Clear({ 1, 1, 1, 1 });
    use.DrawInto(1);
    this->Clear({ 0, 0, 0, 0 });
  }
  std::vector<float> values(8);
  this->Target.Read(0, values);
  EXPECT_EQ(values, std::vector<float>(8, 0));
  this->Target.Read(1, values);
  EXPECT_EQ(values, std::vector<float>(8, 1));
}

TEST_F(FloatTargetTest, CompositesAsAPictureFromMemoryDoes)
{
  FloatTarget::Settings settings;
  settings.Width = 10;
  settings.Height = 6;
  this->Target.Prepare(this->Window, settings);
  const std::array<float, 4> color = { 0.25f, 0.5f, 0.1f, 0.5f };
  {
    const FloatTarget::Use use(this->Target);
    this->Clear(color);
  }
  tetralux::ImageCompositor compositor;
  const tetralux::PixelRectangle rectangle{ 3, 2, 10, 6 };
  const OpenGLSnapshot before = TakeOpenGLSnapshot(this->Window);
  compositor.Composite(this->Window, rectangle, this->Target.GetTexture(0), { 0, 0, 10, 6 });
  EXPECT_EQ(FindDifferences(before, TakeOpenGLSnapshot(this->Window)), "");
  const std::vector<unsigned char> drawn = this->ReadWindow();
  this->Render();
  std::vector<float> colors;
  for (int pixel = 0; pixel < 60; ++pixel)
  {
    colors.insert(colors.end(), color.begin(), color.end());
  }
  tetralux::MemoryPicture picture;
  picture.Width = 10;
  picture.Height = 6;
  picture.Colors = colors.data();
  compositor.Composite(this->Window, rectangle, picture, { 0, 0, 10, 6 });
  EXPECT_EQ(FindDifferences(before, TakeOpenGLSnapshot(this->Window)), "");
  EXPECT_EQ(drawn, this->ReadWindow());
  const std::size_t inside = 4 * (4 * 24 + 5);
  EXPECT_NEAR(drawn[inside], 255 * (0.25 + 0.5 * 0.2), 1);
  EXPECT_NEAR(drawn[inside + 1], 255 * (0.5 + 0.5 * 0.4), 1);
  EXPECT_NEAR(drawn[0], 255 * 0.2, 1);
}

TEST_F(FloatTargetTest, MadeAnewForAnotherWindowAndAfterRelease)
{
  FloatTarget::Settings settings;
  this->Target.Prepare(this->Window, settings);
  {
    vtkNew<vtkHeadlessRenderWindow> other;
    vtkNew<vtkRenderer> renderer;
    other->AddRenderer(renderer);
    other->Render();
    this->Target.Prepare(other, settings);
    this->Target.ReleaseGraphicsResources(other);
  }
  this->Window->MakeCurrent();
  this->Render();
  this->Target.Prepare(this->Window, settings);
  std::vector<float> values(4);
  this->Target.Read(0, values);
  this->Target.ReleaseGraphicsResources(this->Window);
  EXPECT_EQ(this->Target.GetNumberOfBytes(), 0u);
}

TEST_F(FloatTargetTest, ArraysOfShadersLeaveStateAsItWas)
{
  tetralux::TransferFunction function;
  function.Nodes = { { 0, { { 1, 0, 0 }, 0 }, { { 1, 0, 0 }, 0 } },
    { 1, { { 0, 1, 0 }, 1 }, { { 0, 1, 0 }, 1 } } };
  const tetralux::IntervalTable table = tetralux::MakeIntervalTable(function);
  tetralux::SegmentSource source;
  source.Intervals = &table;
  tetralux::GpuSegmentIntegral integral;
  const OpenGLSnapshot before = TakeOpenGLSnapshot(this->Window);
  integral.Update(this->Window, source);
  EXPECT_EQ(FindDifferences(before, TakeOpenGLSnapshot(this->Window)), "");
  EXPECT_EQ(integral.GetNumberOfBytes(), 3u * 64 + 4 * (1024 + 2));
  integral.ReleaseGraphicsResources(this->Window);
  EXPECT_EQ(integral.GetNumberOfBytes(), 0u);
}

TEST_F(FloatTargetTest, TooLargeIsAnErrorOfOneLine)
{
  FloatTarget::Settings settings;
  settings.Width = 1 << 20;
  settings.Height = 1 << 20;
  EXPECT_THROW(this->Target.Prepare(this->Window, settings), std::runtime_error);
}

} // namespace
