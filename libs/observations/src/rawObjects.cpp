// SPDX-License-Identifier: BSD-3-Clause
#include "rawObjects.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/system/datetime.h>
#include <salma/observations/registerClasses.h>

#include <new>
#include <stdexcept>

using mrpt::obs::CObservation;
using mrpt::serialization::CSerializable;

namespace salma::observations {
namespace {

[[noreturn]] void fail(const std::string& file, const std::string& problem) {
    throw std::runtime_error(file + ": " + problem);
}

std::string seconds(double time) {
    std::string text(32, '\0');
    text.resize(static_cast<std::size_t>(std::snprintf(text.data(), text.size(), "%.6f s", time)));
    return text;
}

/// Where a log stands when it cannot be read on.
std::string place(const TRawObjects& read) {
    if (read.count == 0) return "in its first record";
    return "after " + std::to_string(read.count) + " whole records, last good time " +
           seconds(read.lastGoodTime);
}

/// Why the object that comes now cannot be read. MRPT's own words name its sources and go on for
/// lines, so they are left out.
[[noreturn]] void explain(const CLogArchive& in, const TRawObjects& read) {
    const std::string& name = in.lastClass();
    std::string problem = in.refusal();
    if (problem.empty() && !name.empty() && mrpt::rtti::findRegisteredClass(name) == nullptr)
        problem = "holds a record of class '" + name + "', which is not registered";
    else if (problem.empty())
        problem = "is damaged in a record of class '" + name + "'";
    fail(in.getArchiveDescription(), problem + ", " + place(read));
}

void noteTime(const CSerializable::Ptr& object, TRawObjects& read) {
    if (const auto observation = std::dynamic_pointer_cast<CObservation>(object))
        read.lastGoodTime = timeOf(*observation).value_or(read.lastGoodTime);
    if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object))
        for (const auto& observation : *frame)
            if (observation) read.lastGoodTime = timeOf(*observation).value_or(read.lastGoodTime);
}

void store(const std::string& file, const CSerializable::Ptr& object, TRawObjects& read) {
    if (const auto whole = std::dynamic_pointer_cast<mrpt::obs::CRawlog>(object)) {
        // Old programs wrote the log as one object.
        for (std::size_t i = 0; i < whole->size(); ++i) store(file, whole->getAsGeneric(i), read);
        return;
    }
    const bool known = std::dynamic_pointer_cast<CObservation>(object) ||
                       std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object) ||
                       std::dynamic_pointer_cast<mrpt::obs::CActionCollection>(object);
    if (!known)
        fail(file, std::string("is not a rawlog: it holds ") +
                       (object ? object->GetRuntimeClass()->className : "an empty record") + " " +
                       place(read));
    read.objects.push_back(object);
    ++read.count;
    noteTime(object, read);
}

}  // namespace

bool readNext(CLogArchive& in, TRawObjects& read) {
    CSerializable::Ptr object;
    try {
        object = in.ReadObject();
    } catch (const std::bad_alloc&) {
        fail(in.getArchiveDescription(),
             "a record claims more than the memory holds, " + place(read));
    } catch (const std::exception&) {
        if (!in.brokeOff()) explain(in, read);
        return false;
    }
    store(in.getArchiveDescription(), object, read);
    return true;
}

std::optional<double> timeOf(const CObservation& observation) {
    if (observation.timestamp == INVALID_TIMESTAMP) return std::nullopt;
    return mrpt::Clock::toDouble(observation.timestamp);
}

TRawObjects readObjects(const std::string& file, bool acceptTruncated) {
    registerClasses();
    CLogArchive in(file);
    if (!in.beginsAsRawlog()) fail(file, "is not a rawlog");
    TRawObjects read;
    bool whole = true;
    while (whole && !in.atEnd()) whole = readNext(in, read);
    read.truncated = !whole || in.truncated();
    if (read.truncated && (!acceptTruncated || read.objects.empty()))
        fail(file, "is truncated: it breaks off " + place(read));
    return read;
}

}  // namespace salma::observations
