// Where the programs lie that do a part of the work in a process of their own.
#pragma once

#include <filesystem>
#include <string>

namespace fluidtex::foreign {

// The first of these places at which there is a program of that name:
// - beside the program that runs;
// - beside the shared library that this code is in, such as a Python module, and in bin/ of the folders
// above;
// - in the folder that fluidtexPrograms() names;
// - where it was built, `built`, which is also what comes back where there is none.
std::filesystem::path programBeside(const std::string& name, const std::filesystem::path& built);

}  // namespace fluidtex::foreign

// Folder of the programs of an installed library. Defined by cmake/installed_programs.cpp, which the package
// fluidtex adds to what links fluidtex::fluidtex; null elsewhere.
extern "C" [[gnu::weak]] const char* fluidtexPrograms();
