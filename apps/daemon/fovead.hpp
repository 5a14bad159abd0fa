// SPDX-License-Identifier: MIT
//
// The program fovead: its words, its files, and what it does when it is told to end or to read its settings
// anew.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <fovea/base/status.hpp>
#include <fovea/linux/kernel.hpp>
#include <fovea/linux/service_notify.hpp>

#include <common/io.hpp>
#include <common/text.hpp>
#include <daemon/daemon.hpp>
#include <daemon/daemon_files.hpp>
#include <daemon/daemon_options.hpp>
#include <daemon/jobs.hpp>
#include <daemon/linux_world.hpp>
#include <daemon/replay_opening.hpp>
#include <daemon/settings.hpp>
#include <daemon/settings_reader.hpp>
#include <daemon/status_line.hpp>
#include <read/code_job_reader.hpp>

namespace fovea::apps {

/// How the daemon ends, as sysexits has it.
enum DaemonExit : int {
    daemon_ok = 0,
    daemon_usage = 64,        ///< words that it does not know
    daemon_unavailable = 69,  ///< a device is not there, or another has it
    daemon_no_memory = 71,    ///< or no file left to open, before READY
    daemon_io = 74,           ///< a disk hangs while settings are read anew
    daemon_config = 78,       ///< the settings or a job are wrong
};

/// What has to be looked at between two turns; signals set it.
struct DaemonSignals {
    bool end = false;
    bool reload = false;
    bool tell = false;
};

/// The daemon as it runs by one set of files.
/// Opening is CameraOpening or ReplayOpening.
template <class Opening>
class DaemonSession {
public:
    DaemonSession(const DaemonFiles& files, const char* version, typename Opening::Calls system)
        : files_(files),
          world_(files_.settings, files_.jobs, system),
          daemon_(world_, daemon_options(files_.settings, version)),
          version_(version) {}

    /// Empty if all is open, or what is not.
    std::string open() {
        if (std::string problem = world_.open(); !problem.empty()) return problem;
        daemon_.take_job(files_.job);
        tell_start();
        return "";
    }

    /// Takes files whose settings are of the same devices, between two frames: nothing is opened anew.
    void take(const DaemonFiles& fresh) {
        const int job = job_among(fresh);
        files_ = fresh;
        world_.take_settings(files_.settings);
        daemon_.take_options(daemon_options(files_.settings, version_));
        daemon_.take_job(job);
    }
    /// The number of the job that stands in other files for the one that is judged by: the same if it is
    /// still there, unless these files ask for another one to begin with.
    int job_among(const DaemonFiles& fresh) const {
        if (!(fresh.settings.jobs.start == files_.settings.jobs.start)) return fresh.job;
        // What could not be opened has judged nothing yet.
        const int here = daemon_.job() != 0 ? daemon_.job() : files_.job;
        const int same = fresh.jobs.find(span_of(files_.jobs[here].name), 0);
        return same == 0 ? fresh.job : same;
    }

    void tell_reload(const std::string& problem) {
        char room[1024];
        TextBuffer line(room);
        line.text("{\"v\":1,\"ev\":\"").text(problem.empty() ? "reload" : "reload_failed");
        line.text("\",\"t_mono_us\":").number(world_.now_us());
        if (!problem.empty()) line.text(",\"reason\":").json(span_of(problem));
        line.put('}');
        if (!line.full()) world_.print(line.letters());
    }

    LinuxWorld<Opening>& world() { return world_; }
    Daemon<LinuxWorld<Opening>>& daemon() { return daemon_; }

private:
    void tell_start() {
        char room[1024];
        TextBuffer line(room);
        line.text("{\"v\":1,\"ev\":\"start\",\"t_mono_us\":").number(world_.now_us());
        line.text(",\"version\":\"").text(version_).text("\",\"jobs\":").number(files_.jobs.size());
        line.text(",\"job\":").json(span_of(files_.jobs[files_.job].name));
        if (world_.camera().streaming()) {
            const auto& opening = world_.opening();
            line.text(",\"camera\":").json({opening.path().c_str(), opening.path().size()});
            line.text(",\"format\":\"").text(hal::describe(opening.format()));
            line.text("\",\"width\":")
                .number(opening.size().width)
                .text(",\"height\":")
                .number(opening.size().height);
            line.text(",\"interval_us\":").number(world_.frame_interval_us());
            if (opening.control_note()[0] != '\0')
                line.text(",\"note\":").json(letters_of(opening.control_note()));
        }
        line.text(",\"threads\":").number(world_.workers().count()).put('}');
        if (!line.full()) world_.print(line.letters());
    }

    DaemonFiles files_;
    LinuxWorld<Opening> world_;
    Daemon<LinuxWorld<Opening>> daemon_;
    const char* version_;
};

inline const char* fovead_help() {
    return "usage: fovead [options]\n\n"
           "Takes frames of a camera, judges them by a job, and answers on lines, a serial port and as "
           "JSON.\n\n"
           "options:\n"
           "  --config FILE           settings (/etc/fovea/fovead.toml)\n"
           "  --check-config          only say whether settings and jobs are good\n"
           "  --make-safe             only make all lines inactive, after a daemon that was killed\n"
           "  --sample-config         print settings with every key, its default and its help\n"
           "  --settings-manual       the same as text of a manual page\n"
           "  --version               print the version\n"
           "  --help                  print this\n\n"
           "SIGHUP reads settings and jobs anew, SIGTERM ends with all lines inactive.\n"
           "Ends with 0, 64 for wrong words, 69 if a device is missing or taken, 71 without memory, 78 if "
           "settings are wrong.\n";
}

/// Ends a session. A disk that hangs would be waited for without end: then the program ends here, with that
/// status; all lines are inactive.
template <class Session, class Io>
void end_session(Session& session, Io& io, int status) {
    session.daemon().stop();
    if (session.world().finish()) return;
    io.complain("fovead: the disk of [failures] hangs or is slow: ended without what it was to keep");
    ::_exit(status);
}

/// Runs by the files until a signal ends it; reads them anew where one says so.
template <class Opening, class Io, class System, class TakeSignals>
int run_daemon(std::unique_ptr<DaemonSession<Opening>>& session, DaemonFiles& files,
               const std::string& config, Io& io, System system, linux_port::ServiceNotify<System>& notify,
               int signal_file, TakeSignals take_signals, const char* version) {
    const auto begin = [&](DaemonFiles by) {
        Tally tally;
        std::uint64_t number = 0;
        if (session != nullptr) {
            by.job = session->job_among(by);
            // Devices have one owner: the old session ends before the new one begins.
            end_session(*session, io, daemon_io);
            tally = session->daemon().tally();
            number = session->daemon().last_number();
        }
        session.reset();
        session = std::make_unique<DaemonSession<Opening>>(by, version, system);
        session->daemon().go_on_from(tally, number);
        return session->open();
    };
    if (const std::string problem = begin(files); !problem.empty()) {
        io.complain("fovead: " + problem);
        return daemon_unavailable;
    }
    static_cast<void>(notify.ready());
    StatusLine status;
    // Between READY and the end nothing is allocated, but to read the settings anew.
    for (;;) {
        const DaemonSignals signals = take_signals();
        if (signals.end) break;
        if (signals.reload) {
            static_cast<void>(notify.reloading());
            const DaemonFiles fresh = read_daemon_files(config);
            std::string problem = fresh.problem;
            if (problem.empty() &&
                fresh.settings.camera.replay.empty() != files.settings.camera.replay.empty())
                problem = "from a camera to a replay, or back, it has to be started again";
            if (problem.empty() && same_devices(fresh.settings, files.settings)) {
                session->take(fresh);
                files = fresh;
            } else if (problem.empty()) {
                problem = begin(fresh);
                if (problem.empty()) {
                    files = fresh;
                } else if (const std::string worse = begin(files); !worse.empty()) {
                    io.complain("fovead: " + problem + "; and as it was before: " + worse);
                    return daemon_unavailable;
                }
            }
            session->tell_reload(problem);
            if (!problem.empty()) io.complain("fovead: not read anew: " + problem);
            static_cast<void>(notify.ready());
        }
        const std::int64_t next_us = session->daemon().turn();
        // The watchdog is fed by turns that came to their end, and by nothing else.
        notify.feed();
        if (const char* const line = status.turn(session->world(), session->daemon()))
            static_cast<void>(notify.status(line));
        const std::int64_t now_us = session->world().now_us();
        session->world().wait(next_us < now_us + 1000000 ? next_us : now_us + 1000000, signal_file);
    }
    static_cast<void>(notify.stopping());
    end_session(*session, io, daemon_ok);
    return daemon_ok;
}

/// Runs the daemon. take_signals() says what signals came since its last call; signal_file wakes a wait for
/// them.
template <class System, class Io, class TakeSignals>
int fovead(const std::vector<std::string>& words, Io& io, System system,
           const linux_port::NotifyEnvironment& environment, int signal_file, TakeSignals take_signals,
           const char* version) {
    std::string config = "/etc/fovea/fovead.toml";
    bool check = false, make_safe = false;
    for (std::size_t k = 0; k < words.size(); ++k) {
        const std::string& word = words[k];
        if (word == "--help" || word == "-h") return io.print(fovead_help()), daemon_ok;
        if (word == "--version") return io.print(std::string("fovead ") + version + "\n"), daemon_ok;
        if (word == "--sample-config") return io.print(sample_settings()), daemon_ok;
        if (word == "--settings-manual") return io.print(settings_manual() + code_keys_manual()), daemon_ok;
        if (word == "--check-config") {
            check = true;
        } else if (word == "--make-safe") {
            make_safe = true;
        } else if (word == "--config" && k + 1 < words.size()) {
            config = words[++k];
        } else {
            const std::vector<std::string> known = {"--config",        "--check-config",    "--make-safe",
                                                    "--sample-config", "--settings-manual", "--version",
                                                    "--help"};
            io.complain(word == "--config"
                            ? "fovead: --config wants a file"
                            : "fovead: unknown option " + one_line(word) + hint(nearest_name(word, known)));
            return daemon_usage;
        }
    }
    DaemonFiles files = read_daemon_files(config);
    if (!files.problem.empty()) {
        io.complain("fovead: " + files.problem);
        return files.no_file_left ? daemon_no_memory : daemon_config;
    }
    if (check) {
        io.print(config + ": good, " + std::to_string(files.jobs.size()) +
                 (files.jobs.size() == 1 ? " job\n" : " jobs\n"));
        return daemon_ok;
    }
    if (make_safe) {
        LinuxWorld<CameraOpening<System>> world(files.settings, files.jobs, system);
        const std::string problem = world.make_safe();
        if (!problem.empty()) io.complain("fovead: " + problem);
        return problem.empty() ? daemon_ok : daemon_unavailable;
    }
    linux_port::ServiceNotify<System> notify(system, environment);
    const auto run = [&](auto session) {
        return run_daemon(session, files, config, io, system, notify, signal_file, take_signals, version);
    };
    if (files.settings.camera.replay.empty())
        return run(std::unique_ptr<DaemonSession<CameraOpening<System>>>());
    return run(std::unique_ptr<DaemonSession<ReplayOpening<System>>>());
}

}  // namespace fovea::apps
