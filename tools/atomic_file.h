// Files that never bear their final name half written: temporary name, flush to disk, rename.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace fluidtex::tools {

// Calls write(TEMPORARY) with a name in the same folder and the same extension, flushes what it wrote and
// renames it to `file`. The folder is made where missing. Whatever bore the temporary name before is removed;
// a link, not what it leads to. If write throws, or the file cannot be flushed or renamed
// (std::system_error), the temporary file is removed and the exception goes on. It is for `write` to throw
// where the disk took less than it was given: writeBytes() does.
void writeAtomically(const std::filesystem::path& file,
                     const std::function<void(const std::filesystem::path&)>& write);

// The same for a whole folder: `write` fills an empty temporary folder, every file in it is flushed. A folder
// that was there before is taken away just before; killed in between, neither is there, but never a part of
// one.
void writeFolderAtomically(const std::filesystem::path& folder,
                           const std::function<void(const std::filesystem::path&)>& write);

// Puts the bytes into a new file. Throws std::system_error that names it where not every one got there.
void writeBytes(const std::filesystem::path& file, std::string_view bytes);

void writeTextAtomically(const std::filesystem::path& file, std::string_view text);

// Removes a folder that may be there, under a temporary name, so that no part of it ever bears its own.
void removeFolderAtomically(const std::filesystem::path& folder);

// Removes what a killed run left behind under temporary names, directly inside `folder`.
void removeTemporaries(const std::filesystem::path& folder);

}  // namespace fluidtex::tools
