// SPDX-License-Identifier: MIT
//
// Jobs: what the files of a folder say of parts and of codes, all read before the first frame, so that
// another is taken between two frames.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/base/crc32.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/codec/toml.hpp>
#include <fovea/decision/recipe.hpp>
#include <fovea/image/geometry.hpp>

#include <common/io.hpp>
#include <common/text.hpp>
#include <daemon/settings.hpp>
#include <gauge/recipe_reader.hpp>
#include <read/code_job_reader.hpp>

namespace fovea::apps {

struct Job {
    /// Of its file, without .toml.
    std::string name;
    /// Of the bytes of its file.
    std::uint32_t crc = 0;
    /// It measures parts, by the recipe.
    bool gauges = true;
    Recipe recipe;
    /// It reads codes.
    bool reads = false;
    CodeJob codes;
};

/// "" if the text of a job is good, or "line:column: what is wrong".
inline std::string read_job(const std::string& text, Job& job) {
    const auto at = [](TextPlace place, const std::string& problem) {
        return std::to_string(place.line) + ":" + std::to_string(place.column) + ": " + problem;
    };
    const CodeJobFile codes = read_code_job(text);
    job.reads = codes.found;
    job.gauges = !codes.found || !codes.alone;
    if (!codes.problem.empty()) return at(codes.place, codes.problem);
    job.codes = codes.job;
    if (!job.gauges) return "";
    const RecipeFile file = read_recipe(codes.found ? codes.recipe : text);
    job.recipe = file.recipe;
    return file.problem.empty() ? "" : at(file.place, file.problem);
}

/// The jobs in the order of their names; their numbers count from 1.
class JobList {
public:
    static constexpr int most = 256;

    /// Reads the jobs of these names from a storage, NAME.toml below a folder. Empty if all are good;
    /// otherwise what is wrong with the first that is not, and the list is as it was.
    template <class Storage>
    std::string read(Storage& storage, const std::string& folder, std::vector<std::string> names) {
        std::sort(names.begin(), names.end());
        if (names.empty()) return folder + ": no job: `fovea teach` makes a recipe, NAME.toml";
        if (names.size() > most) return folder + ": more than " + std::to_string(most) + " jobs";
        std::vector<Job> fresh;
        for (const std::string& name : names) {
            const std::string path = folder + "/" + name + ".toml";
            const Result<Span<const std::uint8_t>> text = storage.load(path.c_str());
            if (!text) return file_problem(path, text.status(), storage);
            Job job;
            job.name = name;
            job.crc = crc32(*text);
            const std::string problem = read_job(std::string(text->begin(), text->end()), job);
            if (!problem.empty()) return path + ":" + problem;
            fresh.push_back(std::move(job));
        }
        jobs_ = std::move(fresh);
        return "";
    }

    /// Empty if pictures of that size have what all jobs look at; otherwise the first that they have not.
    std::string fit(const std::string& folder, Size picture) const {
        for (const Job& job : jobs_)
            if (job.reads && !job.codes.inside(picture))
                return folder + "/" + job.name + ".toml:" + std::to_string(job.codes.region_place.line) +
                       ":" + std::to_string(job.codes.region_place.column) + ": region: the picture has " +
                       std::to_string(picture.width) + " x " + std::to_string(picture.height) + " px";
        return "";
    }

    int size() const { return static_cast<int>(jobs_.size()); }
    /// Of a number from 1.
    const Job& operator[](int number) const { return jobs_[static_cast<std::size_t>(number - 1)]; }
    /// The number of a job by its name, or by its number as a name; 0 if there is none.
    int find(Span<const char> name, int number) const {
        for (int k = 1; k <= size(); ++k) {
            const std::string& known = (*this)[k].name;
            if (static_cast<std::ptrdiff_t>(known.size()) == name.size() &&
                std::equal(name.begin(), name.end(), known.begin()))
                return k;
        }
        return number >= 1 && number <= size() ? number : 0;
    }

private:
    std::vector<Job> jobs_;
};

/// The names of jobs among the names of files: those that end in .toml and could be sent by a command.
inline std::vector<std::string> job_names(const std::vector<std::string>& files) {
    std::vector<std::string> names;
    for (const std::string& file : files)
        if (file.size() > 5 && file.compare(file.size() - 5, 5, ".toml") == 0)
            names.push_back(file.substr(0, file.size() - 5));
    return names;
}

}  // namespace fovea::apps
