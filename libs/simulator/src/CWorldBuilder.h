// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/simulator/CWorld.h>

#include <map>

namespace salma::simulator {

/// Turns a description into the faces and surfaces of a CWorld.
class CWorldBuilder {
 public:
    CWorldBuilder(const TWorld& description, CWorld& world);
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
    struct TTexture {
        std::shared_ptr<const CMipMap> map;
        double width{0};  //!< Of one tile [m]; 0 for a file, which does not say.
    };
    const TTexture& texture(const std::string& name, bool repeats);
    /// Adds an upright face that starts at `left` and runs `length` along `right`.
    TFace& addUpright(const Eigen::Vector3d& left, const Eigen::Vector3d& right, double length);

    const TWorld& m_description;
    CWorld& m_world;
    std::map<std::pair<std::string, bool>, TTexture> m_textures;  //!< By name and repeats.
    std::vector<TSegment> m_segments;                             //!< At the laser's height.
};

}  // namespace salma::simulator
