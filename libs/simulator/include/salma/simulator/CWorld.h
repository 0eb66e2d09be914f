// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>
#include <salma/simulator/CMipMap.h>
#include <salma/simulator/TWorld.h>

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace salma::simulator {

/// A picture that lies on a surface.
struct TDecal {
    double u0, u1, v0, v1;                   //!< Where, in the surface's coordinates [m].
    std::shared_ptr<const CMipMap> texture;  //!< Stretched over it, upright.
    float gloss{0};                          //!< Share of a lamp's light that it mirrors [-].
};

/// What glass mirrors.
struct TLight {
    Eigen::Vector3d position;  //!< [m]
    double brightness;         //!< Of its middle; white is 1.
    double width;              //!< Sigma of its glow [rad].
};

/// What an area looks like: a tiled texture with pictures on it.
struct TSurface {
    std::shared_ptr<const CMipMap> texture;
    double textureWidth{1};      //!< Of one tile [m].
    std::vector<TDecal> decals;  //!< The last lies on top.
};

/// A plane rectangle of the world: origin + u right + v up, seen from both sides.
struct TFace {
    Eigen::Vector3d origin;  //!< [m]
    Eigen::Vector3d right;   //!< Unit vector of u, to the right as one faces the front.
    Eigen::Vector3d up;      //!< Unit vector of v.
    double u0, u1, v0, v1;   //!< [m]
    std::size_t surface{0};  //!< Index into CWorld::surfaces().
    double brightness{1};    //!< How much light falls on it.
    bool upright{true};      //!< A laser can see it.

    Eigen::Vector3d normal() const { return right.cross(up); }  //!< Towards who faces it.
    Eigen::Vector3d at(double u, double v) const { return origin + u * right + v * up; }
};

/// A straight obstacle at some height.
struct TSegment {
    mrpt::math::TPoint2D from, to;  //!< [m]
};

enum class ETruthKind { salient, corner };

/// A row of the truth: a poster, or an upright edge where two faces meet.
struct TTrueLandmark {
    int id{0};
    ETruthKind kind{ETruthKind::corner};
    Eigen::Vector3d centre;  //!< Of a corner: at the laser's height [m].
    double yaw{0};           //!< Direction of a poster's normal [rad].
    double width{0}, height{0};
    std::string texture;  //!< File name of a poster's picture.
};

class CTextureStore;
class CLandmarkRegister;

/// The geometry and the textures of a world, of one floor in one lap.
class CWorld {
 public:
    /// Nothing at all.
    CWorld() = default;

    /// The first lap on the first floor. Paints or loads the textures. \throw std::runtime_error if
    /// one cannot be read.
    explicit CWorld(const TWorld& description);

    /// Where laps and floors differ (CScenes): all share textures and the numbers of landmarks.
    CWorld(const TWorld& description,
           int lap,
           int floor,
           CTextureStore& textures,
           CLandmarkRegister& landmarks);

    const std::vector<TFace>& faces() const { return m_faces; }
    const std::vector<TSurface>& surfaces() const { return m_surfaces; }
    const std::vector<TLight>& lights() const { return m_lights; }

    /// Adds somebody who stands at `place` [m], in clothes of two colours by `clothes`.
    void addPerson(const mrpt::math::TPoint2D& place,
                   const TPeopleOptions& people,
                   std::uint64_t clothes);

    /// Everything that a horizontal beam at `height` [m] can hit.
    std::vector<TSegment> segmentsAt(double height) const;

    /// Those that are here: posters first, then the corners at the laser's height. Ids count from
    /// 1, posters of all laps and floors before all corners.
    const std::vector<TTrueLandmark>& landmarks() const { return m_landmarks; }

    /// Distance from `from` along the unit vector `direction` to the nearest face [m]; infinity if
    /// nothing is there.
    double distanceTo(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) const;

    /// True if no face lies between the two points (those at the very ends do not count).
    bool visible(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;

 private:
    friend class CWorldBuilder;
    std::vector<TFace> m_faces;
    std::vector<TSurface> m_surfaces;
    std::vector<TLight> m_lights;
    std::vector<TTrueLandmark> m_landmarks;
};

}  // namespace salma::simulator
