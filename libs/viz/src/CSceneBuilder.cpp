// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/math/CMatrixFixed.h>
#include <mrpt/opengl/CEllipsoid3D.h>
#include <mrpt/opengl/CGridPlaneXY.h>
#include <mrpt/opengl/CPointCloud.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/opengl/CText.h>
#include <mrpt/opengl/CTexturedPlane.h>
#include <mrpt/opengl/stock_objects.h>
#include <salma/viz/CRunWriter.h>
#include <salma/viz/CSceneBuilder.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "TPlotFrame.h"

namespace salma::viz {
namespace {

using mrpt::img::TColor;
using mrpt::opengl::CRenderizable;
using mrpt::poses::CPose3D;

/// All that the map shows, at least 10 m wide.
TPlotFrame frameOf(const slam::TRunRecord& record) {
    TPlotFrame frame;
    for (const auto& row : record.trajectory) frame.include({row.pose.x(), row.pose.y()});
    for (const auto& landmark : record.landmarks) frame.include(landmark.mean);
    frame.includeMost(record.scanPoints);
    frame.fit(1);
    return frame;
}

double heightOf(const slam::TMapLandmark& landmark) {
    return landmark.patch ? landmark.patch->pose.mean.z() : 0;
}

CRenderizable::Ptr ellipsoid(const slam::TMapLandmark& landmark, const TColor& colour) {
    mrpt::math::CMatrixDouble33 covariance;
    covariance.setZero();
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) covariance(i, j) = landmark.covariance(i, j);
    covariance(2, 2) = 1e-6;  // the map is flat; a disc needs some thickness to be seen
    auto object = mrpt::opengl::CEllipsoid3D::Create();
    object->setCovMatrix(covariance);
    object->setQuantiles(2);
    object->setColor_u8(colour);
    object->setLocation(landmark.mean.x, landmark.mean.y, heightOf(landmark));
    return object;
}

CRenderizable::Ptr texturedPatch(const slam::TMapLandmark& landmark) {
    const auto& patch = *landmark.patch;
    auto plane = mrpt::opengl::CTexturedPlane::Create();
    const auto halfWidth = static_cast<float>(patch.width / 2);
    const auto halfHeight = static_cast<float>(patch.height / 2);
    plane->setPlaneCorners(-halfWidth, halfWidth, -halfHeight, halfHeight);
    mrpt::img::CImage picture(patch.picture, mrpt::img::DEEP_COPY);
    picture.flipVertical();  // MRPT puts the first row at the smallest y
    plane->assignImage(std::move(picture));
    plane->setPose(patchPose(landmark));
    return plane;
}

bool canBeHung(const slam::TMapLandmark& landmark) {
    return landmark.patch && std::isfinite(landmark.wallAngle) &&
           !landmark.patch->picture.isEmpty() && landmark.patch->width > 0 &&
           landmark.patch->height > 0;
}

}  // namespace

CPose3D patchPose(const slam::TMapLandmark& landmark) {
    const auto& mean = landmark.mean;
    if (!landmark.patch || !std::isfinite(landmark.wallAngle))
        return CPose3D(mean.x, mean.y, heightOf(landmark), 0, 0, 0);
    const double c = std::cos(landmark.wallAngle), s = std::sin(landmark.wallAngle);
    mrpt::math::CMatrixDouble44 T_w_p;
    T_w_p.setIdentity();
    // columns: u to the right as one faces the wall, v up, normal towards the robot
    const double columns[3][4] = {
        {-s, 0, c, mean.x}, {c, 0, s, mean.y}, {0, 1, 0, heightOf(landmark)}};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j) T_w_p(i, j) = columns[i][j];
    return CPose3D(T_w_p);
}

CSceneBuilder::CSceneBuilder(const slam::TRunRecord& record) : m_record(record) {}

mrpt::opengl::COpenGLScene::Ptr CSceneBuilder::build() const {
    auto scene = mrpt::opengl::COpenGLScene::Create();
    scene->insert(grid());
    scene->insert(mrpt::opengl::stock_objects::CornerXYZSimple(0.5F, 2));
    if (!m_record.scanPoints.empty()) scene->insert(scanPoints());
    scene->insert(path());
    for (const auto& l : m_record.landmarks) scene->insert(landmark(l));
    const TPlotFrame frame = frameOf(m_record);
    scene->getViewport()->setCustomBackgroundColor({0.93F, 0.93F, 0.93F});
    auto& camera = scene->getViewport()->getCamera();
    camera.setPointingAt(static_cast<float>((frame.min.x + frame.max.x) / 2),
                         static_cast<float>((frame.min.y + frame.max.y) / 2), 0);
    camera.setZoomDistance(static_cast<float>(1.7 * frame.width()));
    camera.setAzimuthDegrees(-70);
    camera.setElevationDegrees(45);
    return scene;
}

CRenderizable::Ptr CSceneBuilder::grid() const {
    const TPlotFrame frame = frameOf(m_record);
    auto object = mrpt::opengl::CGridPlaneXY::Create(
        static_cast<float>(std::floor(frame.min.x)), static_cast<float>(std::ceil(frame.max.x)),
        static_cast<float>(std::floor(frame.min.y)), static_cast<float>(std::ceil(frame.max.y)),
        0.0F, 1.0F);
    object->setColor_u8(TColor(200, 200, 200, 255));
    object->setName("grid");
    return object;
}

CRenderizable::Ptr CSceneBuilder::scanPoints() const {
    auto cloud = mrpt::opengl::CPointCloud::Create();
    for (const auto& point : m_record.scanPoints)
        cloud->insertPoint(static_cast<float>(point.x), static_cast<float>(point.y), 0);
    cloud->setPointSize(2);
    cloud->setColor_u8(TColor(120, 120, 120, 255));
    cloud->setName("laser");
    return cloud;
}

CRenderizable::Ptr CSceneBuilder::path() const {
    auto lines = mrpt::opengl::CSetOfLines::Create();
    lines->setColor_u8(TColor(20, 20, 20, 255));
    lines->setLineWidth(3);
    lines->setName("path");
    for (std::size_t i = 1; i < m_record.trajectory.size(); ++i) {
        const auto& a = m_record.trajectory[i - 1].pose;
        const auto& b = m_record.trajectory[i].pose;
        lines->appendLine(a.x(), a.y(), 0, b.x(), b.y(), 0);
    }
    return lines;
}

CRenderizable::Ptr CSceneBuilder::landmark(const slam::TMapLandmark& landmark) const {
    const bool salient = landmark.kind == association::ELandmarkKind::salient;
    const std::string name = nameOf(landmark.kind) + " " + std::to_string(landmark.id);
    auto objects = mrpt::opengl::CSetOfObjects::Create();
    objects->setName(name);
    objects->insert(ellipsoid(landmark, salient ? TColor(214, 39, 40) : TColor(31, 95, 208)));
    if (canBeHung(landmark)) objects->insert(texturedPatch(landmark));
    if (salient) {
        auto label = mrpt::opengl::CText::Create(std::to_string(landmark.id));
        label->setColor_u8(TColor(120, 15, 16, 255));
        const double top = landmark.patch ? landmark.patch->height / 2 : 0;
        label->setLocation(landmark.mean.x, landmark.mean.y, heightOf(landmark) + top + 0.15);
        objects->insert(label);
    }
    return objects;
}

}  // namespace salma::viz
