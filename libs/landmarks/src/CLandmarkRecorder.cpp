// SPDX-License-Identifier: BSD-3-Clause
#include <salma/landmarks/CLandmarkRecorder.h>
#include <salma/observations/loadPicture.h>

#include <utility>

namespace salma::landmarks {

using observations::CObservationSalientLandmarks;

CLandmarkRecorder::CLandmarkRecorder(const TRecorderOptions& options)
    : m_frontEnd(options.seeing), m_lines(options.lines), m_placeString(options.placeString) {}

TRecorded CLandmarkRecorder::record(const TJoinedPicture& job,
                                    const std::string& imagesFolder) const {
    TView view;
    view.grey = observations::loadGrey(*job.picture, imagesFolder);
    view.camera = job.picture->cameraParams;
    view.T_r_c = job.T_r_c;
    const laser::TLineResult lines = m_lines.extract(*job.scan);
    for (const auto& line : lines.lines)
        view.walls.push_back(laser::transformed(line, job.T_picture_scan));
    TRecorded out;
    out.result = m_frontEnd.process(view);
    out.record = CObservationSalientLandmarks::Create();
    out.record->sensorLabel = job.picture->sensorLabel + "_SALIENT";
    out.record->timestamp = job.picture->timestamp;
    out.record->cameraPose = view.T_r_c;
    out.record->camera = view.camera;
    if (job.picture->image.isExternallyStored())
        out.record->pictureFile = job.picture->image.getExternalStorageFile();
    out.record->placeString = m_placeString.describe(*job.scan, lines);
    out.record->landmarks = std::move(out.result.landmarks);
    return out;
}

}  // namespace salma::landmarks
