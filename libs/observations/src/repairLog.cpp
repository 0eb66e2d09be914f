// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <mrpt/rtti/CObject.h>
#include <salma/observations/registerClasses.h>
#include <salma/observations/repairLog.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <stdexcept>

#include "CLogArchive.h"
#include "CLogSink.h"
#include "rawObjects.h"

namespace fs = std::filesystem;

namespace salma::observations {
namespace {

constexpr double kPlausible = 3600;  // seconds between the last record and the last write

[[noreturn]] void fail(const std::string& file, const std::string& problem) {
    throw std::runtime_error(file + ": " + problem);
}

void rejectFileInUse(const std::string& file) {
    const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return;  // whoever reads it says why
    const bool locked = flock(descriptor, LOCK_SH | LOCK_NB) != 0;
    close(descriptor);
    if (locked) fail(file, "is in use: a capture still writes it");
}

/// Reads all whole objects and forgets them. \return where the last one ends
std::uint64_t findEnd(CLogArchive& in, TRawObjects& read, TRepair& repair) {
    std::uint64_t end = 0;
    try {
        while (!in.atEnd() && readNext(in, read)) {
            end = in.position();
            read.objects.clear();
        }
    } catch (const std::exception& error) {
        const bool known = mrpt::rtti::findRegisteredClass(in.lastClass()) != nullptr;
        if (read.count == 0 || !known) throw;
        repair.cause = std::string(error.what()).substr(in.getArchiveDescription().size() + 2);
    }
    if (repair.cause.empty() && !in.damage().empty()) repair.cause = "is damaged: " + in.damage();
    if (repair.cause.empty() && (in.truncated() || end < in.size())) repair.cause = "it breaks off";
    return end;
}

/// Seconds since 1970 at which `file` was last written.
double writtenAt(const std::string& file) {
    struct stat state {};
    if (stat(file.c_str(), &state) != 0) return 0;
    return static_cast<double>(state.st_mtim.tv_sec) +
           static_cast<double>(state.st_mtim.tv_nsec) * 1e-9;
}

void copyTo(const std::string& file, std::uint64_t bytes, CLogSink& sink) {
    CLogArchive in(file, true);
    std::array<char, 1U << 16> buffer{};
    for (std::uint64_t done = 0; done < bytes;) {
        const auto part =
            static_cast<std::size_t>(std::min<std::uint64_t>(bytes - done, buffer.size()));
        in.readBytes(buffer.data(), part);
        sink.WriteBuffer(buffer.data(), part);
        done += part;
    }
}

void keepAside(const std::string& file) {
    const std::string aside = file + ".broken";
    if (fs::exists(aside)) fail(aside, "is in the way: it was kept by an earlier repair");
    std::error_code error;
    fs::rename(file, aside, error);
    if (error) fail(file, "cannot be kept aside: " + error.message());
}

}  // namespace

TRepair repairLog(const std::string& file, const std::string& target) {
    registerClasses();
    rejectFileInUse(file);
    CLogArchive in(file, true);
    if (!in.beginsAsRawlog()) fail(file, "is not a rawlog");
    TRepair repair;
    TRawObjects read;
    const std::uint64_t end = findEnd(in, read, repair);
    repair.records = read.count;
    repair.lastGoodTime = read.lastGoodTime;
    repair.bytesKept = end;
    repair.bytesLost = in.size() - end;
    repair.packedBytesLost = in.packedBytesLost();
    repair.whole = repair.cause.empty();
    if (repair.whole) return repair;
    if (read.count == 0) fail(file, "holds no whole record: there is nothing to keep");
    const double late = writtenAt(file) - read.lastGoodTime;
    if (late >= 0 && late < kPlausible) repair.secondsLost = late;
    CLogSink sink(target);
    copyTo(file, end, sink);
    std::error_code error;
    if (fs::equivalent(file, target, error)) keepAside(file);
    sink.publish();
    return repair;
}

}  // namespace salma::observations
