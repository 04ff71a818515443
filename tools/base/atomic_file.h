// Atomic writes: temporary name, flush to disk, rename; no file bears its final name half written.
//
// A temporary name, .tmp-MACHINE-PROCESS-NAME, is that of one process: another one, such as one on a lost
// machine that goes on after all, neither moves nor removes what this one writes. What killed processes have
// left is cleared by the next that writes into the same folder, as far as they ran on its own machine, and
// all of it by whoever holds the folder alone (removeTemporaries).
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace fluidtex::tools {

// Calls write(TEMPORARY) with a name in the same folder and the same extension, flushes the file and renames
// it to `file`. Creates the folder if missing. If write throws, or flush or rename fails (std::system_error),
// the temporary file is removed and the exception propagates. `write` has to throw if the disk takes less
// than it is given, as writeBytes() does.
void writeAtomically(const std::filesystem::path& file,
                     const std::function<void(const std::filesystem::path&)>& write);

// The same for a whole folder: `write` fills an empty temporary folder, whose files are flushed. An existing
// folder is removed just before the rename: a kill in between leaves neither, but never a part of one.
void writeFolderAtomically(const std::filesystem::path& folder,
                           const std::function<void(const std::filesystem::path&)>& write);

// Writes the bytes to a new file. Throws std::system_error that names it unless all of them were written.
void writeBytes(const std::filesystem::path& file, std::string_view bytes);

void writeTextAtomically(const std::filesystem::path& file, std::string_view text);

// Removes a folder, if it exists, under a temporary name, so that no part of it ever bears its own.
void removeFolderAtomically(const std::filesystem::path& folder);

// Calls work(TEMPORARY) with an empty folder inside `folder`, which is made if missing, and removes it
// afterwards. `name` is what it ends in.
void withTemporaryFolder(const std::filesystem::path& folder, const std::string& name,
                         const std::function<void(const std::filesystem::path&)>& work);

// Removes all temporaries directly inside `folder`, whoever wrote them. For those who hold it alone.
void removeTemporaries(const std::filesystem::path& folder);

}  // namespace fluidtex::tools
