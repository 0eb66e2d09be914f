// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/TStrictOptions.h>

#include <string>

namespace salma::apps {

/// Section [global], with rawlog-grabber's keys and meanings.
struct TGlobalOptions : public config::TStrictOptions<TGlobalOptions> {
    std::string prefix{"dataset"};
    int launchPause{300};        //!< Between the starts of two sensors [ms].
    double frameTimeSpan{0.25};  //!< Longest time that a sensory frame spans [s].
    bool sensoryFrames{false};   //!< Actions and sensory frames instead of observations.
    int grabberPeriod{1000};     //!< Not needed here: TGrabOptions::memberTime decides [ms].
    int compression{1};          //!< 0 (none) to 9.

    void visit(config::COptionVisitor& visitor);
};

/// What a sensor that fails means for the others.
enum class EOnFailure {
    carryOn,  //!< The others go on, the program ends with exit code 1.
    restart,  //!< As before, and the sensor is made anew until it works.
    stop      //!< All end, as in rawlog-grabber.
};

/// Section [salma-grab]; absent in an ini file that was written for rawlog-grabber.
struct TGrabOptions : public config::TStrictOptions<TGrabOptions> {
    EOnFailure onFailure{EOnFailure::carryOn};
    double restartTime{2};        //!< Between attempts to start a failed sensor [s].
    double holdTime{0.15};        //!< A record waits so long for older ones of other sensors [s].
    double memberTime{0.25};      //!< A gzip member is completed after so long [s].
    double silentTime{5};         //!< A sensor without a record for so long is told [s].
    double stopTime{5};           //!< Sensors may take so long to end [s].
    bool externalPictures{true};  //!< Pictures as files in X_Images, as rawlog-grabber keeps them.
    bool checkPictures{true};     //!< Look for black, cut and missing pictures.
    std::string ignore{"true"};   //!< "rawlog-grabber-ignore": this section is no sensor.

    void visit(config::COptionVisitor& visitor);
    /// \throw std::invalid_argument, also if a crash could cost more than a second.
    void validate() const;
};

}  // namespace salma::apps
