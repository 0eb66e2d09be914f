// SPDX-License-Identifier: BSD-3-Clause
#include <SQLiteCpp/SQLiteCpp.h>
#include <mrpt/serialization/CSerializable.h>
#include <salma/landmarks/CLandmarkDatabase.h>
#include <salma/observations/CObservationSalientLandmarks.h>
#include <salma/observations/registerClasses.h>

#include <filesystem>
#include <stdexcept>
#include <utility>

namespace salma::landmarks {
namespace {

constexpr int kVersion = 1;

constexpr auto kSchema =
    "CREATE TABLE landmark(id INTEGER PRIMARY KEY, kind TEXT NOT NULL, x_m REAL NOT NULL,"
    " y_m REAL NOT NULL, var_x_m2 REAL NOT NULL, cov_xy_m2 REAL NOT NULL, var_y_m2 REAL NOT NULL,"
    " sightings INTEGER NOT NULL, first_t_s REAL NOT NULL, last_t_s REAL NOT NULL);"
    "CREATE TABLE patch(landmark_id INTEGER PRIMARY KEY REFERENCES landmark(id),"
    " width_m REAL NOT NULL, height_m REAL NOT NULL, record BLOB NOT NULL);";

using observations::CObservationSalientLandmarks;

void insertPatch(SQLite::Database& db, int id, const observations::TPatch& patch) {
    CObservationSalientLandmarks record;
    record.timestamp = mrpt::Clock::time_point();  // not the time of writing
    record.landmarks = {patch};
    std::vector<std::uint8_t> bytes;
    mrpt::serialization::ObjectToOctetVector(&record, bytes);
    SQLite::Statement row(db, "INSERT INTO patch VALUES(?,?,?,?)");
    row.bind(1, id);
    row.bind(2, patch.width);
    row.bind(3, patch.height);
    row.bind(4, bytes.data(), static_cast<int>(bytes.size()));
    row.exec();
}

void insertLandmark(SQLite::Database& db, const TStoredLandmark& landmark) {
    SQLite::Statement row(db, "INSERT INTO landmark VALUES(?,?,?,?,?,?,?,?,?,?)");
    row.bind(1, landmark.id);
    row.bind(2, landmark.kind);
    const double numbers[] = {landmark.mean.x, landmark.mean.y, landmark.covariance(0, 0),
                              landmark.covariance(0, 1), landmark.covariance(1, 1)};
    for (int i = 0; i < 5; ++i) row.bind(3 + i, numbers[i]);
    row.bind(8, landmark.sightings);
    row.bind(9, landmark.firstTime);
    row.bind(10, landmark.lastTime);
    row.exec();
    if (landmark.patch) insertPatch(db, landmark.id, *landmark.patch);
}

std::shared_ptr<const observations::TPatch> patchOf(const SQLite::Column& blob) {
    const auto* data = static_cast<const std::uint8_t*>(blob.getBlob());
    const std::vector<std::uint8_t> bytes(data, data + blob.getBytes());
    mrpt::serialization::CSerializable::Ptr object;
    mrpt::serialization::OctetVectorToObject(bytes, object);
    const auto record = std::dynamic_pointer_cast<CObservationSalientLandmarks>(object);
    if (!record || record->landmarks.size() != 1)
        throw std::runtime_error("a patch is not readable");
    return std::make_shared<observations::TPatch>(record->landmarks[0]);
}

TStoredLandmark landmarkOf(SQLite::Statement& row) {
    TStoredLandmark landmark;
    landmark.id = row.getColumn(0);
    landmark.kind = row.getColumn(1).getString();
    landmark.mean = {row.getColumn(2), row.getColumn(3)};
    landmark.covariance << row.getColumn(4).getDouble(), row.getColumn(5).getDouble(),
        row.getColumn(5).getDouble(), row.getColumn(6).getDouble();
    landmark.sightings = row.getColumn(7);
    landmark.firstTime = row.getColumn(8);
    landmark.lastTime = row.getColumn(9);
    if (!row.getColumn(10).isNull()) landmark.patch = patchOf(row.getColumn(10));
    return landmark;
}

}  // namespace

CLandmarkDatabase::CLandmarkDatabase(std::string file) : m_file(std::move(file)) {}

void CLandmarkDatabase::create(const std::vector<TStoredLandmark>& landmarks) const {
    if (std::filesystem::exists(m_file)) throw std::runtime_error(m_file + ": exists already");
    try {
        SQLite::Database db(m_file, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
        SQLite::Transaction all(db);
        db.exec(kSchema);
        for (const auto& landmark : landmarks) insertLandmark(db, landmark);
        db.exec("PRAGMA user_version = " + std::to_string(kVersion));
        all.commit();
    } catch (const SQLite::Exception& e) {
        throw std::runtime_error(m_file + ": " + e.what());
    }
}

std::vector<TStoredLandmark> CLandmarkDatabase::read() const {
    observations::registerClasses();
    if (!std::filesystem::exists(m_file)) throw std::runtime_error(m_file + ": no such file");
    try {
        SQLite::Database db(m_file, SQLite::OPEN_READONLY);
        const int version = db.execAndGet("PRAGMA user_version");
        if (version != kVersion)
            throw std::runtime_error("is a database of version " + std::to_string(version) +
                                     ", not " + std::to_string(kVersion));
        SQLite::Statement row(db,
                              "SELECT l.*, p.record FROM landmark l LEFT JOIN patch p"
                              " ON p.landmark_id = l.id ORDER BY l.id");
        std::vector<TStoredLandmark> landmarks;
        while (row.executeStep()) landmarks.push_back(landmarkOf(row));
        return landmarks;
    } catch (const std::exception& e) {
        throw std::runtime_error(m_file + ": " + e.what());
    }
}

}  // namespace salma::landmarks
