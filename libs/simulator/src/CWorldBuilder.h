// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/simulator/CWorld.h>

#include "CLandmarkRegister.h"
#include "CTextureStore.h"

namespace salma::simulator {

/// Which part of a description is built.
struct TScene {
    const TWorld& description;
    int lap, floor;
};

/// Turns a description into the faces and surfaces of a CWorld.
class CWorldBuilder {
 public:
    CWorldBuilder(const TScene& scene,
                  CTextureStore& textures,
                  CLandmarkRegister& landmarks,
                  CWorld& world);
    void build();

 private:
    void addFloorAndCeiling();
    void addWall(const TWall& wall);
    void addDoor(const TWall& wall, const TDoor& door, double at);
    void addBox(const TBox& box);
    void addPoster(const TPoster& poster, TSurface& surface);
    void addCorners();
    bool isCorner(const mrpt::math::TPoint2D& point, std::size_t segment) const;

    std::size_t addSurface(const std::string& texture, double textureWidth);
    /// Adds an upright face that starts at `left` and runs `length` along `right`.
    TFace& addUpright(const Eigen::Vector3d& left, const Eigen::Vector3d& right, double length);

    const TWorld& m_description;
    int m_lap, m_floor;
    CTextureStore& m_textures;
    CLandmarkRegister& m_register;
    CWorld& m_world;
    std::vector<TSegment> m_segments;  //!< At the laser's height.
};

}  // namespace salma::simulator
