// SPDX-License-Identifier: BSD-3-Clause
#include <salma/association/CDataAssociator.h>
#include <salma/association/CJointCompatibility.h>
#include <salma/association/CNearestNeighbour.h>
#include <salma/association/CSaliencyAssociation.h>
#include <salma/association/CSequentialCompatibility.h>

namespace salma::association {

TDropCounts& TDropCounts::operator+=(const TDropCounts& other) {
    invisible += other.invisible;
    kind += other.kind;
    identity += other.identity;
    wallAngle += other.wallAngle;
    singular += other.singular;
    distance += other.distance;
    appearance += other.appearance;
    joint += other.joint;
    return *this;
}

std::unique_ptr<CDataAssociator> createAssociator(const TAssociationOptions& options) {
    switch (options.method) {
        case EMethod::nn:
            return std::make_unique<CNearestNeighbour>(options);
        case EMethod::scnn:
            return std::make_unique<CSequentialCompatibility>(options);
        case EMethod::jcbb:
            return std::make_unique<CJointCompatibility>(options);
        default:
            return std::make_unique<CSaliencyAssociation>(options);
    }
}

}  // namespace salma::association
