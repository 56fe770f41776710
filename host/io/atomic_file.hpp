// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <ostream>

#include "io/output_buffer.hpp"

namespace boxwood {

/// A file that appears under its name whole or not at all. Bytes go to a temporary name in the same folder, made of
/// the name, the process id and a count, so that neither two processes nor two threads share one; commit() renames it.
/// A process that dies in between leaves at most the temporary, which the next one of the same name removes: the lock
/// that a temporary has while it is written tells those of the dead. Not synchronised to disk: it guards against a
/// failing or killed program, not against a power cut.
class AtomicFile {
public:
    /// Opens the temporary, and removes those of `path` that processes left which are certainly dead. Throws
    /// OutputError naming `path` when its folder is missing or not writable, or when `path` exists and is not a regular
    /// file (so that a device or a folder is never replaced).
    explicit AtomicFile(const std::filesystem::path& path);

    /// Removes the temporary unless commit() has succeeded. Never throws.
    ~AtomicFile();

    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// Where the bytes go: binary, seekable. A failed write sets the stream's state, which commit() checks, so that
    /// writers need no check of their own.
    std::ostream& stream() { return stream_; }

    /// Flushes, closes and renames, replacing an older file. Throws OutputError naming the file and the system's reason
    /// when any write failed (disk full, for example) or the rename does; the older file is then untouched. Call it
    /// once, last.
    void commit();

private:
    std::filesystem::path path_;
    std::filesystem::path temporary_;
    int descriptor_ = -1; ///< -1 once closed.
    std::optional<OutputBuffer> buffer_;
    std::ostream stream_{nullptr};
};

} // namespace boxwood
