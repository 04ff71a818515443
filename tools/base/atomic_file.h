// Atomic writes: temporary name, flush to disk, rename; no file bears its final name half written.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace fluidtex::tools {

// Calls write(TEMPORARY) with a name in the same folder and the same extension, flushes the file and renames
// it to `file`. Creates the folder if missing. Removes what bore the temporary name before; of a link, the
// link. If write throws, or flush or rename fails (std::system_error), the temporary file is removed and the
// exception propagates. `write` has to throw if the disk takes less than it is given, as writeBytes() does.
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

// Removes temporaries of a killed run directly inside `folder`.
void removeTemporaries(const std::filesystem::path& folder);

}  // namespace fluidtex::tools
