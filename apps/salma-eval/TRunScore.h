// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace salma::apps {

/// Counts of one kind of landmark in one run, as TAssociationFigures defines them.
struct TKindScore {
    std::uint64_t right{0}, judged{0};          //!< Pairings; precision is their quotient.
    std::uint64_t recalled{0}, resightings{0};  //!< Recall is their quotient.
    std::uint64_t wrong{0};                     //!< Pairings between two true landmarks.
    std::uint64_t wrongWithFalse{0};            //!< Pairings of a true one with a false one.
    std::uint64_t deferred{0};                  //!< Of the re-sightings.
    std::uint64_t made{0}, trueLandmarks{0}, covered{0}, duplicates{0}, falseLandmarks{0};

    /// Calls visit(name, field) for each; names are those of columns and keys, behind `prefix`.
    template <class SELF, class VISITOR>
    static void forEach(SELF& s, const std::string& prefix, const VISITOR& visit) {
        visit(prefix + "right", s.right);
        visit(prefix + "judged", s.judged);
        visit(prefix + "recalled", s.recalled);
        visit(prefix + "resightings", s.resightings);
        visit(prefix + "wrong", s.wrong);
        visit(prefix + "wrong_with_false", s.wrongWithFalse);
        visit(prefix + "deferred", s.deferred);
        visit(prefix + "made", s.made);
        visit(prefix + "true", s.trueLandmarks);
        visit(prefix + "covered", s.covered);
        visit(prefix + "duplicates", s.duplicates);
        visit(prefix + "false_landmarks", s.falseLandmarks);
    }
};

/// How one run compares with the truth. NaN stands for what could not be computed.
struct TRunScore {
    static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

    std::uint64_t steps{0};
    double ate{kNone};             //!< RMSE of position, whole path aligned in SE(2) [m].
    double ateLastLap{kNone};      //!< Of the last lap alone, aligned by itself [m].
    double lastLapInPath{kNone};   //!< Of the same poses, aligned as the whole path [m].
    double ateOdometry{kNone};     //!< Of odometry alone, whole path [m].
    double rpePosition{kNone};     //!< RMSE over 1 m of the true path [m].
    double rpeHeading{kNone};      //!< The same [rad].
    double finalError{kNone};      //!< Of the last position, in the frame of the first pose [m].
    double maxJump{kNone};         //!< Most that one step added to the error of position [m].
    double nees{kNone};            //!< Mean over the steps; 3 is expected.
    std::uint64_t neesSteps{0};    //!< Steps whose covariance is regular.
    std::vector<double> neesAt;    //!< At fixed shares of the path's time, see TPoseConsistency.
    std::uint64_t relocations{0};  //!< Steps with a decision "relocated".
    std::uint64_t repeatedWrongPairs{0};  //!< Salient landmarks that were paired with one other
                                          //!< true landmark in two steps or more.
    std::uint64_t wrongCopies{0};  //!< Pairings of a poster with a copy of it: same texture, other
                                   //!< landmark.
    TKindScore salient, corners;

    /// Calls visit(name, field) for each field. Angles are in degrees in columns named _deg only.
    template <class SELF, class VISITOR>
    static void forEach(SELF& s, const VISITOR& visit) {
        visit("steps", s.steps);
        visit("ate_m", s.ate);
        visit("ate_last_lap_m", s.ateLastLap);
        visit("last_lap_in_path_m", s.lastLapInPath);
        visit("ate_odometry_m", s.ateOdometry);
        visit("rpe_1m_m", s.rpePosition);
        visit("rpe_1m_rad", s.rpeHeading);
        visit("final_error_m", s.finalError);
        visit("max_jump_m", s.maxJump);
        visit("nees", s.nees);
        visit("nees_steps", s.neesSteps);
        visit("nees_at", s.neesAt);
        visit("relocations", s.relocations);
        visit("repeated_wrong_pairs", s.repeatedWrongPairs);
        visit("wrong_copies", s.wrongCopies);
        TKindScore::forEach(s.salient, "salient_", visit);
        TKindScore::forEach(s.corners, "corner_", visit);
    }
};

/// What names a run: two runs with one key have the same result.
struct TRunKey {
    std::string world;      //!< Name of its file, without ending.
    std::string worldHash;  //!< Of all that the simulated log is made from, the seed apart.
    std::string noise;      //!< "low", "medium", "high".
    std::uint32_t seed{0};  //!< Of log and run.
    std::string backend;    //!< As the command line of salma-slam has it; so below.
    std::string method;
    std::string configHash;  //!< Of config.ini, back end and method apart.

    template <class SELF, class VISITOR>
    static void forEach(SELF& s, const VISITOR& visit) {
        visit("world", s.world);
        visit("world_md5", s.worldHash);
        visit("noise", s.noise);
        visit("seed", s.seed);
        visit("backend", s.backend);
        visit("method", s.method);
        visit("config_md5", s.configHash);
    }
};

/// A line of results.jsonl.
struct TRunResult {
    TRunKey key;
    std::string program;       //!< Hash of the program that made it.
    std::string failure;       //!< "" if the run came to its end; else there is no score.
    double cpuSeconds{0};      //!< Processor time of the child process [s].
    double mappingSeconds{0};  //!< Of it, association and filter [s].
    TRunScore score;

    bool failed() const { return !failure.empty(); }

    template <class SELF, class VISITOR>
    static void forEach(SELF& s, const VISITOR& visit) {
        TRunKey::forEach(s.key, visit);
        visit("program_md5", s.program);
        visit("failure", s.failure);
        visit("cpu_s", s.cpuSeconds);
        visit("mapping_cpu_s", s.mappingSeconds);
        TRunScore::forEach(s.score, visit);
    }
};

}  // namespace salma::apps
