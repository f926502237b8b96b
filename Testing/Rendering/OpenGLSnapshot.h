// SPDX-License-Identifier: BSD-3-Clause
#ifndef OpenGLSnapshot_h
#define OpenGLSnapshot_h

#include <map>
#include <string>
#include <vector>

class vtkOpenGLRenderWindow;

/// What of OpenGL's state drawing code has to leave as it found it, by name: switches, functions,
/// masks, frame buffers, viewport and scissor, the active texture unit, and which units are taken.
/// Not what is bound to free units, nor how pixels are unpacked: VTK's textures leave both as they
/// used them, and set them before each use.
using OpenGLSnapshot = std::map<std::string, std::vector<double>>;

/// From OpenGL itself; also checks that VTK's record of it, which later drawing relies on, agrees.
/// The window's context has to be current.
OpenGLSnapshot TakeOpenGLSnapshot(vtkOpenGLRenderWindow* window);

/// The names of what differs, one a line; empty where nothing does.
std::string FindDifferences(const OpenGLSnapshot& before, const OpenGLSnapshot& after);

#endif
