// SPDX-License-Identifier: BSD-3-Clause
// What MRPT's programs ask of a metric map: observations, files, definitions and views.
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/opengl/CEllipsoid2D.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/serialization/CArchive.h>
#include <salma/slam/CSalientLandmarkMap.h>
#include <salma/slam/CSharedParts.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <ostream>
#include <stdexcept>

#include "CObservationMeasurements.h"
#include "CRecordMeasurements.h"

namespace salma::slam {

using association::ELandmarkKind;
using association::TMeasurement;
using observations::CObservationSalientLandmarks;
using observations::TPatch;

IMPLEMENTS_SERIALIZABLE(CSalientLandmarkMap, mrpt::maps::CMetricMap, salma::slam)

MAP_DEFINITION_REGISTER("salma::slam::CSalientLandmarkMap,salientLandmarkMap",
                        salma::slam::CSalientLandmarkMap)

CSalientLandmarkMap::TMapDefinition::TMapDefinition()
    : setup(std::make_shared<const CLandmarkMapSetup>()) {}

void CSalientLandmarkMap::TMapDefinition::loadFromConfigFile_map_specific(
    const mrpt::config::CConfigFileBase& source, const std::string& prefix) {
    TLandmarkMapSetup options;
    options.load(source, prefix);
    setup = std::make_shared<const CLandmarkMapSetup>(options);
}

void CSalientLandmarkMap::TMapDefinition::dumpToTextStream_map_specific(std::ostream& out) const {
    out << setup->options().asIni("salientLandmarkMap");
}

mrpt::maps::CMetricMap* CSalientLandmarkMap::internal_CreateFromMapDefinition(
    const mrpt::maps::TMetricMapInitializer& definition) {
    const auto& own = dynamic_cast<const TMapDefinition&>(definition);
    return new CSalientLandmarkMap(own.setup);  // MRPT takes it over
}

namespace {

/// Measurements of the kinds of observation that the map takes; null for others.
Measurements measurementsOf(const mrpt::obs::CObservation& observation,
                            const TLandmarkMapSetup& options) {
    Measurements result;
    if (const auto* record = dynamic_cast<const CObservationSalientLandmarks*>(&observation))
        result = CRecordMeasurements::instance().of(*record);
    else if (const auto* step = dynamic_cast<const CObservationMeasurements*>(&observation))
        result = Measurements(Measurements(), &step->measurements);
    else if (const auto* ranges =
                 dynamic_cast<const mrpt::obs::CObservationBearingRange*>(&observation))
        result = std::make_shared<std::vector<TMeasurement>>(
            slam::measurementsOf(*ranges, options.rangeBearing));
    if (!result || !options.map.ignoreIdentities) return result;
    auto anonymous = std::make_shared<std::vector<TMeasurement>>(*result);
    for (TMeasurement& m : *anonymous) m.identity.reset();
    return anonymous;
}

}  // namespace

bool CSalientLandmarkMap::internal_insertObservation(
    const mrpt::obs::CObservation& observation,
    const std::optional<const mrpt::poses::CPose3D>& robotPose) {
    const auto measurements = measurementsOf(observation, m_setup->options());
    if (!measurements || measurements->empty()) return false;
    learn(*measurements, mrpt::poses::CPose2D(robotPose.value_or(mrpt::poses::CPose3D())),
          mrpt::Clock::toDouble(observation.timestamp));
    return true;
}

bool CSalientLandmarkMap::internal_canComputeObservationLikelihood(
    const mrpt::obs::CObservation& observation) const {
    const auto measurements = measurementsOf(observation, m_setup->options());
    return measurements && !measurements->empty();
}

double CSalientLandmarkMap::internal_computeObservationLikelihood(
    const mrpt::obs::CObservation& observation, const mrpt::poses::CPose3D& takenFrom) const {
    const auto measurements = measurementsOf(observation, m_setup->options());
    return measurements ? logLikelihood(*measurements, mrpt::poses::CPose2D(takenFrom),
                                        mrpt::Clock::toDouble(observation.timestamp))
                        : 0;
}

// ---- Streams

namespace {

using mrpt::serialization::CArchive;

constexpr std::uint32_t kMostLandmarks = 10'000'000;
constexpr std::uint32_t kMostViews = 1000;

bool isMemory(const CArchive& archive) {
    using TMemory = mrpt::serialization::CArchiveStreamBase<mrpt::io::CMemoryStream>;
    return dynamic_cast<const TMemory*>(&archive) != nullptr;
}

std::uint32_t readCount(CArchive& in, std::uint32_t most, const std::string& what) {
    const auto count = in.ReadAs<std::uint32_t>();
    if (count > most)
        throw std::runtime_error("A landmark map claims " + std::to_string(count) + " " + what);
    return count;
}

void writeViews(CArchive& out, const std::vector<TView>& views, bool complete) {
    out << static_cast<std::uint32_t>(views.size());
    CObservationSalientLandmarks record;  // the format of patches is that of the record
    for (const TView& view : views) {
        out << view.angle;
        if (complete)
            record.landmarks.push_back(*view.patch);
        else
            out << CSharedParts<TPatch>::instance().numberOf(view.patch);
    }
    if (complete && !views.empty()) out << record;
}

std::vector<TView> readViews(CArchive& in, bool complete) {
    std::vector<TView> views(readCount(in, kMostViews, "views of a landmark"));
    for (TView& view : views) {
        in >> view.angle;
        if (complete) continue;
        view.patch = CSharedParts<TPatch>::instance().find(in.ReadAs<std::uint64_t>());
        if (!view.patch)
            throw std::runtime_error(
                "A landmark map was read from memory after the map that wrote it had gone");
    }
    if (!complete || views.empty()) return views;
    CObservationSalientLandmarks record;
    in >> record;
    if (record.landmarks.size() != views.size())
        throw std::runtime_error("A landmark of a map has " + std::to_string(views.size()) +
                                 " views and " + std::to_string(record.landmarks.size()) +
                                 " patches");
    for (std::size_t i = 0; i < views.size(); ++i)
        views[i].patch = std::make_shared<const TPatch>(record.landmarks[i]);
    return views;
}

template <class MATRIX>
void writeNumbers(CArchive& out, const MATRIX& m) {
    for (Eigen::Index i = 0; i < m.size(); ++i) out << static_cast<double>(m.data()[i]);
}

/// \throw std::runtime_error if one is not finite.
template <class MATRIX>
void readNumbers(CArchive& in, MATRIX& m) {
    for (Eigen::Index i = 0; i < m.size(); ++i) in >> m.data()[i];
    if (!m.allFinite()) throw std::runtime_error("A landmark map holds a place that is no number");
}

void writeLandmark(CArchive& out, const TLandmark& l, bool complete) {
    out << static_cast<std::int32_t>(l.id) << static_cast<std::uint8_t>(l.kind) << l.convex
        << l.identity.has_value() << static_cast<std::int32_t>(l.identity.value_or(0))
        << l.wallAngle << l.wallAngleSigma << l.firstWallAngle << l.firstMean.x << l.firstMean.y;
    writeNumbers(out, l.firstCovariance);
    out << static_cast<std::uint64_t>(l.sightings) << l.firstTime << l.lastTime
        << l.countedAngle.has_value() << l.countedAngle.value_or(0)
        << static_cast<std::uint32_t>(l.lookAlikes.size());
    for (const int other : l.lookAlikes) out << static_cast<std::int32_t>(other);
    writeViews(out, l.views, complete);
}

TLandmark readLandmark(CArchive& in, bool complete, std::uint8_t version) {
    TLandmark l;
    l.id = in.ReadAs<std::int32_t>();
    l.kind = in.ReadAs<std::uint8_t>() == 0 ? ELandmarkKind::salient : ELandmarkKind::corner;
    in >> l.convex;
    const bool known = in.ReadAs<bool>();
    const auto identity = in.ReadAs<std::int32_t>();
    if (known) l.identity = identity;
    in >> l.wallAngle >> l.wallAngleSigma >> l.firstWallAngle >> l.firstMean.x >> l.firstMean.y;
    readNumbers(in, l.firstCovariance);
    l.sightings = static_cast<std::size_t>(in.ReadAs<std::uint64_t>());
    in >> l.firstTime >> l.lastTime;
    if (version > 0) {  // version 0 counted appearance each time
        const bool counted = in.ReadAs<bool>();
        const double angle = in.ReadAs<double>();
        if (counted) l.countedAngle = angle;
        const auto others = readCount(in, kMostLandmarks, "look-alikes of a landmark");
        for (std::uint32_t k = 0; k < others; ++k) l.lookAlikes.insert(in.ReadAs<std::int32_t>());
    }
    l.views = readViews(in, complete);
    return l;
}

std::shared_ptr<const CLandmarkMapSetup> setupOf(const std::string& ini) {
    TLandmarkMapSetup options;
    options.load(mrpt::config::CConfigFileMemory(ini), "map");
    return std::make_shared<const CLandmarkMapSetup>(options);
}

}  // namespace

std::uint8_t CSalientLandmarkMap::serializeGetVersion() const { return 1; }

void CSalientLandmarkMap::serializeTo(CArchive& out) const {
    const bool complete = !isMemory(out);
    out << complete;
    if (complete)
        out << m_setup->options().asIni("map");
    else
        out << processNumber() << CSharedParts<CLandmarkMapSetup>::instance().numberOf(m_setup);
    out << genericMapParams.enableSaveAs3DObject << genericMapParams.enableObservationLikelihood
        << genericMapParams.enableObservationInsertion << tag
        << static_cast<std::uint64_t>(m_insertions) << static_cast<std::int32_t>(m_table.nextId())
        << static_cast<std::uint32_t>(size());
    for (std::size_t k = 0; k < size(); ++k) {
        writeNumbers(out, m_places[k].mean);
        writeNumbers(out, m_places[k].covariance);
        out << static_cast<std::uint64_t>(m_places[k].born);
        writeLandmark(out, m_table[k], complete);
    }
}

void CSalientLandmarkMap::serializeFrom(CArchive& in, std::uint8_t version) {
    if (version > 1)
        throw std::runtime_error("A landmark map of version " + std::to_string(version) +
                                 "; this program knows versions 0 and 1");
    const bool complete = in.ReadAs<bool>();
    if (complete) {
        m_setup = setupOf(in.ReadAs<std::string>());
    } else {
        const auto process = in.ReadAs<std::uint64_t>();
        const auto setup = in.ReadAs<std::uint64_t>();
        const auto found = CSharedParts<CLandmarkMapSetup>::instance().find(setup);
        if (process != processNumber() || !found)
            throw std::runtime_error(
                "A landmark map was read from memory after the map that wrote it had gone");
        m_setup = found;
    }
    m_ratio = m_setup->patchRatio();
    const auto& options = m_setup->options().map;
    m_table = CLandmarkTable(options.maxPatches, options.patchSpread);
    m_outcomes = {};
    in >> genericMapParams.enableSaveAs3DObject >> genericMapParams.enableObservationLikelihood >>
        genericMapParams.enableObservationInsertion >> tag;
    m_insertions = static_cast<std::size_t>(in.ReadAs<std::uint64_t>());
    const auto nextId = in.ReadAs<std::int32_t>();
    const auto count = readCount(in, kMostLandmarks, "landmarks");
    std::vector<TLandmark> landmarks;
    m_places.clear();
    for (std::uint32_t k = 0; k < count; ++k) {
        TPlace place;
        readNumbers(in, place.mean);
        readNumbers(in, place.covariance);
        place.born = static_cast<std::size_t>(in.ReadAs<std::uint64_t>());
        m_places.push_back(place);
        landmarks.push_back(readLandmark(in, complete, version));
    }
    m_table.restore(std::move(landmarks), nextId);
}

// ---- Views

void CSalientLandmarkMap::saveMetricMapRepresentationToFile(const std::string& prefix) const {
    const std::string file = prefix + "_landmarks.csv";
    std::ofstream out(file);
    out << "id,kind,x_m,y_m,sigma_x_m,sigma_y_m,sightings\n";
    for (std::size_t k = 0; k < size(); ++k) {
        if (!isConfirmed(k)) continue;
        const TPlace& p = m_places[k];
        out << m_table[k].id << ','
            << (m_table[k].kind == ELandmarkKind::salient ? "salient" : "corner") << ','
            << p.mean[0] << ',' << p.mean[1] << ',' << std::sqrt(p.covariance(0, 0)) << ','
            << std::sqrt(p.covariance(1, 1)) << ',' << m_table[k].sightings << '\n';
    }
    if (!out.flush()) throw std::runtime_error(file + ": cannot be written");
}

void CSalientLandmarkMap::getVisualizationInto(mrpt::opengl::CSetOfObjects& objects) const {
    if (!genericMapParams.enableSaveAs3DObject) return;
    for (std::size_t k = 0; k < size(); ++k) {
        if (!isConfirmed(k)) continue;
        const auto ellipse = mrpt::opengl::CEllipsoid2D::Create();
        ellipse->setCovMatrix(mrpt::math::CMatrixDouble22(m_places[k].covariance));
        ellipse->setLocation(m_places[k].mean[0], m_places[k].mean[1], 0);
        ellipse->setQuantiles(3);
        const bool salient = m_table[k].kind == ELandmarkKind::salient;
        ellipse->setColor_u8(mrpt::img::TColor(salient ? 220 : 60, 60, salient ? 60 : 220));
        ellipse->setName(std::to_string(m_table[k].id));
        objects.insert(ellipse);
    }
}

}  // namespace salma::slam
