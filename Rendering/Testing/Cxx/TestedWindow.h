// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestedWindow_h
#define TestedWindow_h

#include "ImageTester.h"

#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"

/// A window that needs no display; with --window or -I one of the display.
vtkSmartPointer<vtkRenderWindow> MakeTestedWindow(ImageTester* tester);

/// Puts a renderer into a window of 200 x 200 pixels, before a background of its own.
void ShowRenderer(vtkRenderWindow* window, vtkRenderer* renderer);

/// Adds an opaque sphere.
void AddSphere(vtkRenderer* renderer, double x, double y, double z, double radius);

/// Compares the window with its baseline; with -I hands it to the user. threshold: see ImageTester.
/// Returns what main returns.
int TestWindow(ImageTester* tester, vtkRenderWindow* window, double threshold);

#endif
