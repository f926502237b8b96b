// SPDX-License-Identifier: BSD-3-Clause
#ifndef Supervisor_h
#define Supervisor_h

#include <functional>

/// Runs the tool's work in a child process and watches over it, so that libraries that crash, hang
/// or end the process at a damaged file become an ordinary error, and so that whatever ends the
/// work leaves nothing behind. The mesh need not be handed over: the process that reads goes on to
/// render, and the watching costs nothing but the start of a process.
///
/// Call it before any thread is started. Signals that ask the process to end are passed on.
///
/// Returns the exit status, in the watching process alone: what work returns; 128 + signal after a
/// signal that asked it to end, as shells report it; 1, with one line on standard error, after all
/// else.
int Supervise(const std::function<int()>& work);

#endif
