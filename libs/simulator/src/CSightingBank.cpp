// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/system/crc.h>
#include <salma/observations/CObservationSalientLandmarks.h>
#include <salma/observations/registerClasses.h>
#include <salma/simulator/CSightingBank.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace salma::simulator {

using mrpt::io::CMemoryStream;
using mrpt::serialization::archiveFrom;
using observations::CObservationSalientLandmarks;

namespace {

const std::string kMark = "salma bank of sightings 1\n";
constexpr std::size_t kHeadSizes = 8;  // bytes of the head's length and checksum

using Bytes = std::vector<std::uint8_t>;

Bytes bytesOf(CMemoryStream& stream) {
    const auto* begin = static_cast<const std::uint8_t*>(stream.getRawBufferData());
    return {begin, begin + stream.getTotalBytesCount()};
}

std::uint32_t checksum(const Bytes& bytes) { return mrpt::system::compute_CRC32(bytes); }

Bytes packed(const TBankedView& view) {
    CMemoryStream stream;
    auto archive = archiveFrom(stream);
    archive << view.T_w_r.x << view.T_w_r.y << view.T_w_r.phi << view.pan;
    CObservationSalientLandmarks patches;   // the record knows how to write them
    patches.timestamp = INVALID_TIMESTAMP;  // else now
    for (const auto& s : view.sightings) patches.landmarks.push_back(s.patch);
    archive << patches;
    for (const auto& s : view.sightings)
        archive << s.centre.x() << s.centre.y() << s.centre.z() << s.stretch;
    return bytesOf(stream);
}

TBankedView unpacked(const Bytes& bytes) {
    CMemoryStream stream;
    stream.assignMemoryNotOwn(bytes.data(), bytes.size());
    auto archive = archiveFrom(stream);
    TBankedView view;
    archive >> view.T_w_r.x >> view.T_w_r.y >> view.T_w_r.phi >> view.pan;
    CObservationSalientLandmarks patches;
    archive >> patches;
    for (auto& patch : patches.landmarks) {
        TBankedSighting s;
        s.patch = std::move(patch);
        archive >> s.centre.x() >> s.centre.y() >> s.centre.z() >> s.stretch;
        view.sightings.push_back(std::move(s));
    }
    return view;
}

/// A key as it counts: what an ini file says of a value, in its comments, may change.
std::string withoutComments(const std::string& key) {
    std::istringstream lines(key);
    std::string line, result;
    while (std::getline(lines, line)) {
        line.erase(std::min(line.find(" //"), line.size()));
        line.erase(line.find_last_not_of(' ') + 1);
        result += line + '\n';
    }
    return result;
}

/// The first line of `text` that `other` has not at the same place.
std::string firstDifference(const std::string& text, const std::string& other) {
    std::istringstream a(text), b(other);
    std::string line, otherLine;
    while (std::getline(a, line))
        if (!std::getline(b, otherLine) || line != otherLine) return line;
    return "";
}

}  // namespace

void CSightingBank::fail(const std::string& problem) const {
    throw std::runtime_error(m_file.string() + ": " + problem);
}

CSightingBank::CSightingBank(const std::filesystem::path& file) : m_file(file) {
    if (!std::filesystem::is_regular_file(file)) fail("no such bank of sightings");
    std::ifstream in(file, std::ios::binary);
    m_bytes.assign(std::istreambuf_iterator<char>(in), {});
    if (!in) fail("cannot be read");
    observations::registerClasses();  // the archive makes them by name
    readHead();
}

void CSightingBank::readHead() {
    const std::size_t start = kMark.size() + kHeadSizes;
    if (m_bytes.size() < start || !std::equal(kMark.begin(), kMark.end(), m_bytes.begin()))
        fail("is not a bank of sightings");
    CMemoryStream sizes;
    sizes.assignMemoryNotOwn(m_bytes.data() + kMark.size(), kHeadSizes);
    auto sizesArchive = archiveFrom(sizes);
    std::uint32_t length = 0, sum = 0;
    sizesArchive >> length >> sum;
    if (length > m_bytes.size() - start) fail("breaks off in its index");
    const Bytes head(m_bytes.begin() + static_cast<std::ptrdiff_t>(start),
                     m_bytes.begin() + static_cast<std::ptrdiff_t>(start + length));
    if (checksum(head) != sum) fail("is damaged: the checksum of its index does not fit");

    CMemoryStream stream;
    stream.assignMemoryNotOwn(head.data(), head.size());
    auto archive = archiveFrom(stream);
    std::uint32_t draws = 0;
    archive >> m_key >> draws;
    std::size_t at = start + length;
    for (std::uint32_t draw = 0; draw < draws; ++draw) {
        std::uint32_t pictures = 0;
        archive >> pictures;
        m_index.emplace_back();
        for (std::uint32_t i = 0; i < pictures; ++i) {
            std::uint32_t size = 0;
            TPlace place;
            archive >> size >> place.checksum;
            place.start = at;
            place.size = size;
            at += size;
            m_index.back().push_back(place);
        }
    }
    if (at > m_bytes.size()) fail("breaks off: views are missing at its end");
    if (at < m_bytes.size()) fail("is damaged: there is more in it than its index says");
}

TBankedView CSightingBank::view(std::size_t draw, std::size_t picture) const {
    const TPlace& place = m_index.at(draw).at(picture);
    const auto begin = m_bytes.begin() + static_cast<std::ptrdiff_t>(place.start);
    const Bytes bytes(begin, begin + static_cast<std::ptrdiff_t>(place.size));
    if (checksum(bytes) != place.checksum)
        fail("is damaged: the checksum of picture " + std::to_string(picture) + ", draw " +
             std::to_string(draw) + ", does not fit");
    return unpacked(bytes);
}

void CSightingBank::requireKey(const std::string& key) const {
    const std::string a = withoutComments(m_key), b = withoutComments(key);
    if (a == b) return;
    const std::string own = firstDifference(a, b), wanted = firstDifference(b, a);
    throw std::invalid_argument(m_file.string() + ": is a bank of something else: it has '" + own +
                                "' where this run has '" + wanted +
                                "'; delete it, or name another file");
}

void CSightingBank::write(const std::filesystem::path& file,
                          const std::string& key,
                          const std::vector<std::vector<TBankedView>>& views) {
    CMemoryStream head;
    auto headArchive = archiveFrom(head);
    Bytes all;
    headArchive << key << static_cast<std::uint32_t>(views.size());
    for (const auto& draw : views) {
        headArchive << static_cast<std::uint32_t>(draw.size());
        for (const auto& view : draw) {
            const Bytes bytes = packed(view);
            headArchive << static_cast<std::uint32_t>(bytes.size()) << checksum(bytes);
            all.insert(all.end(), bytes.begin(), bytes.end());
        }
    }
    const Bytes headBytes = bytesOf(head);
    CMemoryStream sizes;
    auto sizesArchive = archiveFrom(sizes);
    sizesArchive << static_cast<std::uint32_t>(headBytes.size()) << checksum(headBytes);

    const std::filesystem::path partial = file.string() + "." + std::to_string(getpid());
    std::ofstream out(partial, std::ios::binary);
    const auto put = [&out](const Bytes& bytes) {
        out.write(reinterpret_cast<const char*>(bytes.data()),
                  static_cast<std::streamsize>(bytes.size()));
    };
    out << kMark;
    put(bytesOf(sizes));
    put(headBytes);
    put(all);
    out.close();
    std::error_code error;
    if (out) std::filesystem::rename(partial, file, error);
    if (!out || error) {
        std::filesystem::remove(partial, error);
        throw std::runtime_error(file.string() + ": cannot be written");
    }
}

}  // namespace salma::simulator
