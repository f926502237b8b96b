// SPDX-License-Identifier: BSD-3-Clause
#include "OpenGLSnapshot.h"

#include "OpenGL/LoadedFunctions.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkTextureUnitManager.h"

#include <gtest/gtest.h>

namespace
{

struct Item
{
  const char* Name;
  GLenum Parameter;
  int Count = 1;
};

constexpr Item Items[] = { { "blend", GL_BLEND }, { "depth test", GL_DEPTH_TEST },
  { "stencil test", GL_STENCIL_TEST }, { "cull face", GL_CULL_FACE },
  { "scissor test", GL_SCISSOR_TEST }, { "multisample", GL_MULTISAMPLE },
  { "depth clamp", GL_DEPTH_CLAMP }, { "program point size", GL_PROGRAM_POINT_SIZE },
  { "depth mask", GL_DEPTH_WRITEMASK }, { "depth function", GL_DEPTH_FUNC },
  { "color mask", GL_COLOR_WRITEMASK, 4 }, { "clear color", GL_COLOR_CLEAR_VALUE, 4 },
  { "clear depth", GL_DEPTH_CLEAR_VALUE }, { "clear stencil", GL_STENCIL_CLEAR_VALUE },
  { "blend source", GL_BLEND_SRC_RGB }, { "blend destination", GL_BLEND_DST_RGB },
  { "blend source alpha", GL_BLEND_SRC_ALPHA }, { "blend destination alpha", GL_BLEND_DST_ALPHA },
  { "blend equation", GL_BLEND_EQUATION_RGB }, { "blend equation alpha", GL_BLEND_EQUATION_ALPHA },
  { "stencil function", GL_STENCIL_FUNC }, { "stencil reference", GL_STENCIL_REF },
  { "stencil value mask", GL_STENCIL_VALUE_MASK }, { "stencil write mask", GL_STENCIL_WRITEMASK },
  { "stencil fail", GL_STENCIL_FAIL }, { "stencil depth fail", GL_STENCIL_PASS_DEPTH_FAIL },
  { "stencil pass", GL_STENCIL_PASS_DEPTH_PASS }, { "viewport", GL_VIEWPORT, 4 },
  { "scissor", GL_SCISSOR_BOX, 4 }, { "draw frame buffer", GL_DRAW_FRAMEBUFFER_BINDING },
  { "read frame buffer", GL_READ_FRAMEBUFFER_BINDING }, { "draw buffer", GL_DRAW_BUFFER0 },
  { "second draw buffer", GL_DRAW_BUFFER1 }, { "read buffer", GL_READ_BUFFER },
  { "active texture", GL_ACTIVE_TEXTURE }, { "pack alignment", GL_PACK_ALIGNMENT },
  { "pack buffer", GL_PIXEL_PACK_BUFFER_BINDING },
  { "unpack buffer", GL_PIXEL_UNPACK_BUFFER_BINDING },
  { "vertex array", GL_VERTEX_ARRAY_BINDING } };

/// As many units as anything here uses.
constexpr int NumberOfUnits = 16;

} // namespace

OpenGLSnapshot TakeOpenGLSnapshot(vtkOpenGLRenderWindow* window)
{
  OpenGLSnapshot snapshot;
  for (const Item& item : Items)
  {
    std::vector<double> values(item.Count);
    glGetDoublev(item.Parameter, values.data());
    snapshot[item.Name] = values;
  }
  std::vector<double>& units = snapshot["texture units taken"];
  for (int k = 0; k < NumberOfUnits; ++k)
  {
    units.push_back(window->GetTextureUnitManager()->IsAllocated(k));
  }

  // What VTK thinks.
  vtkOpenGLState* state = window->GetState();
  for (const GLenum capability :
    { GL_BLEND, GL_DEPTH_TEST, GL_STENCIL_TEST, GL_CULL_FACE, GL_SCISSOR_TEST, GL_MULTISAMPLE })
  {
    EXPECT_EQ(state->GetEnumState(capability), glIsEnabled(capability) == GL_TRUE) << capability;
  }
  int viewport[4];
  state->vtkglGetIntegerv(GL_VIEWPORT, viewport);
  EXPECT_EQ(std::vector<double>(viewport, viewport + 4), snapshot["viewport"]);
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  return snapshot;
}

std::string FindDifferences(const OpenGLSnapshot& before, const OpenGLSnapshot& after)
{
  std::string differences;
  for (const auto& [name, values] : before)
  {
    if (after.at(name) != values)
    {
      differences += name + ": " + testing::PrintToString(values) + " before, " +
        testing::PrintToString(after.at(name)) + " after\n";
    }
  }
  return differences;
}
