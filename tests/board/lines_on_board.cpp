// SPDX-License-Identifier: MIT
//
// The lines of a GPIO chip on the kernel's drivers: the board's PL061, whose other ends the host drives and
// sees, and a chip of gpio-sim. It prints "ready NAME" where the host is to do something, and goes on with a
// line from it.
// usage: lines_on_board outputs|inputs|burst|levels|debounce|busy|names|sweep...
#include <sys/stat.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include <fovea/linux/gpio.hpp>
#include <fovea/linux/gpio_chip.hpp>

#include "board/proof.hpp"
#include "support/failing_system.hpp"

namespace fovea::board {
namespace {

using linux_port::GpioChip;
using linux_port::InputLine;
using linux_port::InputLineOptions;
using linux_port::Kernel;
using linux_port::LineEdge;
using linux_port::LineEdges;
using linux_port::LineLevel;
using linux_port::OutputLine;
using linux_port::OutputLineOptions;

constexpr std::int64_t second = 1000000;

/// Tells the host that it may begin; it answers when it has done its part.
void ready(const char* name) { std::cout << "ready " << name << std::endl; }
void await_host() {
    std::string line;
    std::getline(std::cin, line);
}

bool open_pl061(Proof& proof, GpioChip<>& chip) {
    return proof.status(chip.open("pl061"), Status::ok, "lines: the chip by a part of its label");
}

/// Waits for an edge and takes it.
Status await_edge(InputLine<>& line, LineEdge& edge, std::int64_t patience_us) {
    Kernel kernel;
    pollfd asked{line.file(), POLLIN, 0};
    if (kernel.poll({&asked, 1}, patience_us) <= 0) return Status::timeout;
    return line.next_edge(edge);
}

void outputs(Proof& proof) {
    GpioChip chip;
    if (!open_pl061(proof, chip)) return;
    ready("outputs");
    await_host();
    OutputLine<> high;
    OutputLine<> low;
    OutputLineOptions active_low;
    active_low.active = LineLevel::low;
    proof.status(high.open(chip, "5", "ok"), Status::ok, "lines: an output");
    proof.status(low.open(chip, "6", "ng", active_low), Status::ok, "lines: one that is active at low level");
    bool set = true;
    for (const bool active : {true, false, true}) set = high.set(active) == Status::ok && set;
    for (const bool active : {true, false}) set = low.set(active) == Status::ok && set;
    set = high.set(false) == Status::ok && set;
    proof.check(set, "lines: outputs are set");
    proof.check(high.active() && !*high.active() && low.active() && !*low.active(),
                "lines: both are inactive");
    ready("outputs were set");
    await_host();
}

/// 200 edges, each answered by an output, which the host waits for: a chip merges edges that come faster than
/// its interrupts are served, and a busy host serves them late.
void inputs(Proof& proof) {
    GpioChip chip;
    if (!open_pl061(proof, chip)) return;
    InputLine<> line;
    InputLineOptions options;
    options.edges = LineEdges::both;
    if (!proof.status(line.open(chip, "2", "trigger", options), Status::ok, "lines: an input")) return;
    OutputLine<> echo;
    if (!proof.status(echo.open(chip, "5", "ok"), Status::ok, "lines: its answer")) return;
    Kernel kernel;
    ready("inputs");
    int right = 0;
    std::int64_t last_us = 0;
    std::vector<std::int64_t> delays;
    for (std::uint32_t k = 1; k <= 200; ++k) {
        LineEdge edge;
        if (await_edge(line, edge, 5 * second) != Status::ok) break;
        const std::int64_t now = kernel.monotonic_us();
        if (edge.number == k && edge.active == (k % 2 == 1) && edge.lost == 0 && edge.time_us >= last_us &&
            edge.time_us <= now)
            ++right;
        last_us = edge.time_us;
        delays.push_back(now - edge.time_us);
        if (echo.set(edge.active) != Status::ok) break;
    }
    await_host();
    proof.equal(right, 200, "lines: 200 edges in their order, with rising stamps, none lost");
    proof.equal(line.lost_edges(), 0u, "lines: and none is counted as lost");
    proof.spread("lines: from the stamp of an edge to the program", delays);
}

/// Takes what is left of edges that nobody took in time. The chip may have merged some.
void take_burst(Proof& proof, InputLine<>& line, std::uint64_t at_least, const std::string& what) {
    LineEdge edge;
    std::uint64_t taken = 0;
    while (line.next_edge(edge) == Status::ok) ++taken;
    proof.equal(taken, 16u, "F17: " + what + ": the 16 edges that were kept are taken");
    proof.equal(line.lost_edges() + taken, edge.number, "F17: " + what + ": the others are counted as lost");
    proof.check(edge.number >= at_least && edge.number <= 100,
                "F17: " + what + ": the newest is among those kept", std::to_string(edge.number));
}

InputLineOptions few_kept() {
    InputLineOptions options;
    options.edges = LineEdges::both;
    options.kept_edges = 16;
    return options;
}

/// 100 edges, of which nobody takes one before the last.
void burst(Proof& proof) {
    GpioChip chip;
    if (!open_pl061(proof, chip)) return;
    InputLine<> line;
    if (!proof.status(line.open(chip, "2", "trigger", few_kept()), Status::ok, "lines: an input")) return;
    ready("burst");
    await_host();
    take_burst(proof, line, 50, "a burst from outside");
}

/// Active at low level: the host drives 1, 0, 1, 0.
void levels(Proof& proof) {
    GpioChip chip;
    if (!open_pl061(proof, chip)) return;
    InputLine<> line;
    InputLineOptions options;
    options.active = LineLevel::low;
    if (!proof.status(line.open(chip, "4", "start", options), Status::ok, "lines: an input")) return;
    ready("levels");
    await_host();
    proof.check(line.active() && *line.active(), "lines: a low level is active");
    LineEdge edge;
    int edges = 0;
    while (line.next_edge(edge) == Status::ok) edges += edge.active ? 1 : 100;
    proof.equal(edges, 2, "lines: of 1, 0, 1, 0 two edges are activations, no other is told");
    proof.check(line.take_edge() && !*line.take_edge(), "lines: and none is left");
}

/// The host bounces within 20 ms and ends at 1.
void debounce(Proof& proof) {
    GpioChip chip;
    if (!open_pl061(proof, chip)) return;
    InputLine<> line;
    InputLineOptions options;
    options.edges = LineEdges::both;
    options.debounce_us = 50000;
    if (!proof.status(line.open(chip, "7", "switch", options), Status::ok, "lines: debounced")) return;
    ready("debounce");
    await_host();
    LineEdge edge;
    int edges = 0;
    bool active = false;
    while (await_edge(line, edge, 300000) == Status::ok) ++edges, active = edge.active;
    proof.check(edges == 1 && active, "lines: what bounces is one edge", std::to_string(edges) + " edges");
}

void busy(Proof& proof) {
    GpioChip chip;
    if (!open_pl061(proof, chip)) return;
    InputLine<> line;
    proof.status(line.open(chip, "3", "trigger"), Status::io_error, "F16: a line that the kernel holds");
    proof.equal(line.fault().error, EBUSY, "F16: is busy");
    proof.equal(std::string(line.holder()), "GPIO Key Poweroff", "F16: its holder is named");
    OutputLine<> own;
    proof.status(own.open(chip, "1", "light"), Status::ok, "F16: a line of ours");
    proof.status(line.open(chip, "1", "trigger"), Status::io_error, "F16: a second time");
    proof.equal(std::string(line.holder()), "fovea:light", "F16: its holder is named too");
    proof.status(line.open(chip, "8", "trigger"), Status::not_found,
                 "F16: a line that the chip does not have");
    proof.status(chip.open("/dev/null"), Status::unsupported, "F16: a file that is no chip");
    proof.status(chip.open("no such label"), Status::not_found, "F16: a label that is not there");
}

/// A chip of gpio-sim with 12 lines of which two have names.
class SimulatedChip {
public:
    SimulatedChip() {
        ::mkdir(folder, 0700);
        ::mkdir((std::string(folder) + "/bank").c_str(), 0700);
        write("/bank/num_lines", "12");
        write("/bank/label", "simulated");
        for (const auto& [number, name] : {std::pair{"10", "trigger"}, std::pair{"11", "light"}}) {
            ::mkdir((std::string(folder) + "/bank/line" + number).c_str(), 0700);
            write(std::string("/bank/line") + number + "/name", name);
        }
        write("/live", "1");
        std::getline(std::ifstream(std::string(folder) + "/dev_name"), device_);
        std::getline(std::ifstream(std::string(folder) + "/bank/chip_name"), chip_);
    }
    void remove() { write("/live", "0"); }
    void pull(const char* line, bool up) const {
        std::ofstream(attribute(line) + "/pull") << (up ? "pull-up" : "pull-down");
    }
    std::string value(const char* line) const {
        std::string text;
        std::getline(std::ifstream(attribute(line) + "/value"), text);
        return text;
    }

private:
    static constexpr const char* folder = "/sys/kernel/config/gpio-sim/board";
    static void write(const std::string& file, const std::string& text) {
        std::ofstream(folder + file) << text;
    }
    std::string attribute(const char* line) const {
        return "/sys/devices/platform/" + device_ + "/" + chip_ + "/sim_gpio" + line;
    }

    std::string device_;
    std::string chip_;
};

void names(Proof& proof) {
    const Holdings before = holdings();
    {
        SimulatedChip simulated;
        GpioChip chip;
        if (!proof.status(chip.open("simulated"), Status::ok, "lines: a chip by its label")) return;
        InputLine<> trigger;
        OutputLine<> light;
        proof.status(trigger.open(chip, "trigger", "trigger"), Status::ok, "lines: an input by its name");
        proof.status(light.open(chip, "light", "light"), Status::ok, "lines: an output by its name");
        simulated.pull("10", true);
        LineEdge edge;
        proof.status(await_edge(trigger, edge, second), Status::ok, "lines: the line of that name");
        proof.check(light.set(true) == Status::ok && simulated.value("11") == "1",
                    "lines: and that of the other", simulated.value("11"));
        trigger.close();
        simulated.pull("10", false);
        proof.status(trigger.open(chip, "trigger", "trigger", few_kept()), Status::ok, "lines: few are kept");
        for (int k = 0; k < 100; ++k) simulated.pull("10", k % 2 == 0);
        take_burst(proof, trigger, 100, "a burst of 100");
        // With an edge watched, the kernel's own driver does not survive that.
        trigger.close();
        simulated.remove();
        proof.status(light.set(false), Status::device_lost,
                     "lines: an output of a chip that is gone is lost");
        proof.check(!light.is_open(), "lines: and closed");
        proof.status(trigger.open(chip, "trigger", "trigger"), Status::device_lost,
                     "lines: nothing can be had of it");
    }
    proof.equal(holdings().files, before.files, "lines: as many files are open as before");
}

void sweep(Proof& proof) {
    const Holdings before = holdings();
    int leaks = 0;
    int typed = 0;
    const int runs = test::sweep(
        Kernel(), {EINTR, EIO, EINVAL, ENODEV, ENOMEM, EBUSY, EACCES, EAGAIN},
        [&](auto system) {
            using System = decltype(system);
            GpioChip<System> chip(system);
            OutputLine<System> output(system);
            InputLine<System> input(system);
            Status got = chip.open("pl061");
            if (got == Status::ok) got = output.open(chip, "5", "ok");
            if (got == Status::ok) got = output.set(true);
            if (got == Status::ok) got = output.set(false);
            if (got == Status::ok) got = input.open(chip, "2", "trigger");
            if (got == Status::ok) got = input.active().status();
            LineEdge edge;
            if (got == Status::ok) got = input.next_edge(edge);
            // Without an edge the last call ends so.
            if (got != Status::ok) ++typed;
        },
        [&](const test::SystemScript& script) {
            if (!script.all_given_back()) ++leaks;
        });
    proof.figure("n-th-call sweep of lines on PL061: runs", runs, "");
    proof.check(runs > 100 && typed >= runs, "lines: the sweep reaches every call, each fault has its status",
                std::to_string(typed) + " of " + std::to_string(runs));
    proof.equal(leaks, 0, "lines: no file is left");
    proof.equal(holdings().files, before.files, "lines: by the count of the kernel too");
}

}  // namespace
}  // namespace fovea::board

int main(int count, char** words) {
    using namespace fovea::board;
    Proof proof;
    for (int k = 1; k < count; ++k) {
        const std::string part = words[k];
        if (part == "outputs")
            outputs(proof);
        else if (part == "inputs")
            inputs(proof);
        else if (part == "burst")
            burst(proof);
        else if (part == "levels")
            levels(proof);
        else if (part == "debounce")
            debounce(proof);
        else if (part == "busy")
            busy(proof);
        else if (part == "names")
            names(proof);
        else if (part == "sweep")
            sweep(proof);
        else
            proof.check(false, "a part named " + part);
    }
    return proof.end();
}
