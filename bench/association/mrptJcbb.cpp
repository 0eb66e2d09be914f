// SPDX-License-Identifier: BSD-3-Clause
#include "mrptJcbb.h"

#include <mrpt/slam/data_association.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <ctime>
#include <system_error>

namespace salma::bench {
namespace {

TMrptOutcome compute(const association::TAssociationProblem& problem) {
    const std::size_t observations = problem.measurements.size();
    const std::size_t landmarks = problem.landmarks.size();
    mrpt::math::CMatrixDouble Z(observations, 2), Y(landmarks, 2);
    mrpt::math::CMatrixDouble S(problem.predictionCovariance);
    for (std::size_t i = 0; i < observations; ++i)
        for (int k = 0; k < 2; ++k) Z(i, k) = problem.measurements[i].z[k];
    for (std::size_t j = 0; j < landmarks; ++j)
        for (int k = 0; k < 2; ++k) {
            Y(j, k) = problem.landmarks[j].z[k];
            S(2 * j + k, 2 * j + k) += problem.measurements[0].R(k, k);  // the same for all
        }
    mrpt::slam::TDataAssociationResults results;
    const std::clock_t start = std::clock();
    mrpt::slam::data_association_full_covariance(Z, Y, S, results, mrpt::slam::assocJCBB,
                                                 mrpt::slam::metricMaha, 0.99, false);
    TMrptOutcome outcome;
    outcome.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    outcome.nodes = results.nNodesExploredInJCBB;
    outcome.landmarks.assign(observations, -1);
    for (const auto& [observation, landmark] : results.associations)
        outcome.landmarks[observation] = static_cast<int>(landmark);
    return outcome;
}

/// Numbers of an outcome in a row: small enough to pass a pipe at once.
std::vector<double> packed(const TMrptOutcome& outcome) {
    std::vector<double> numbers{outcome.seconds, static_cast<double>(outcome.nodes)};
    numbers.insert(numbers.end(), outcome.landmarks.begin(), outcome.landmarks.end());
    return numbers;
}

}  // namespace

std::optional<TMrptOutcome> mrptJcbb(const association::TAssociationProblem& problem,
                                     double limit) {
    int ends[2];
    if (pipe(ends) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
    const pid_t child = fork();
    if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
    std::vector<double> numbers(2 + problem.measurements.size());
    const std::size_t bytes = numbers.size() * sizeof(double);
    if (child == 0) {
        const std::vector<double> result = packed(compute(problem));
        _exit(write(ends[1], result.data(), bytes) == static_cast<ssize_t>(bytes) ? 0 : 1);
    }
    close(ends[1]);
    pollfd ready{ends[0], POLLIN, 0};
    const bool done = poll(&ready, 1, static_cast<int>(1000 * limit)) == 1 &&
                      read(ends[0], numbers.data(), bytes) == static_cast<ssize_t>(bytes);
    if (!done) kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    close(ends[0]);
    if (!done) return std::nullopt;
    TMrptOutcome outcome;
    outcome.seconds = numbers[0];
    outcome.nodes = static_cast<std::size_t>(numbers[1]);
    for (std::size_t i = 2; i < numbers.size(); ++i)
        outcome.landmarks.push_back(static_cast<int>(numbers[i]));
    return outcome;
}

}  // namespace salma::bench
