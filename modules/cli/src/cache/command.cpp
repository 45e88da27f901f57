// SPDX-License-Identifier: MIT
#include "arguments.hpp"
#include "cache/cache.hpp"
#include "commands.hpp"
#include "memory.hpp"
#include "model.hpp"
#include "motion/motion.hpp"
#include "threads.hpp"

#include <CLI/CLI.hpp>

#include <charconv>
#include <memory>
#include <utility>

namespace goffer::cli {
namespace {

struct CacheOptions {
    std::filesystem::path input;
    std::filesystem::path output;
    std::optional<std::string> format, isa, shard, extract;
    std::optional<std::uint64_t> shard_size, shard_frames, shard_instances;
    bool prepare = false, verify = false;
    int threads = 0;
    mesh::LoadOptions load;
    std::filesystem::path json;
};

/// Two whole numbers with `between` between them.
std::optional<std::pair<std::uint64_t, std::uint64_t>> two_numbers(const std::string& text, char between) {
    std::pair<std::uint64_t, std::uint64_t> two;
    const char* end = text.data() + text.size();
    const auto [middle, fault] = std::from_chars(text.data(), end, two.first);
    if (fault != std::errc() || middle == end || *middle != between) return std::nullopt;
    const auto [last, error] = std::from_chars(middle + 1, end, two.second);
    if (error != std::errc() || last != end) return std::nullopt;
    return two;
}

void refuse_words(const CLI::App& command, std::initializer_list<const char*> words, const char* with) {
    for (const char* word : words) {
        if (command.get_option(word)->count() > 0)
            throw UsageError(std::string(word) + " cannot be combined with " + with);
    }
}

void require_output(const CacheOptions& options, const char* what) {
    if (options.output.empty()) throw UsageError(std::string("-o is missing: ") + what);
}

void run_extract(const CacheOptions& options) {
    require_output(options, "where the model is to be written");
    const auto place = two_numbers(*options.extract, ',');
    if (!place)
        throw UsageError("--extract: '" + *options.extract +
                         "' is not the numbers of a frame and an instance, as in 0,12");
    const std::vector<NamedFile> outputs = {{"-o", options.output}, {"--json", options.json}};
    check_places({}, outputs);
    check_outside(options.input, outputs);
    extract({options.input, options.output, place->first, place->second, options.load, options.json});
}

void run_make(const CacheOptions& options) {
    require_output(options, "the folder of the cache");
    CacheRequest request;
    request.scene = options.input;
    request.folder = options.output;
    request.shard_size = options.shard_size;
    request.shard_frames = options.shard_frames;
    request.shard_instances = options.shard_instances;
    request.prepare = options.prepare;
    request.threads = usable_threads(options.threads);
    request.load = options.load;
    request.json = options.json;
    if (options.format) request.format = parse_format(*options.format);
    if (options.isa) request.isa = parse_isa_option(*options.isa);
    if (options.shard) {
        const auto share = two_numbers(*options.shard, '/');
        if (!share || share->first < 1 || share->first > share->second || share->second > most_shards)
            throw UsageError("--shard: '" + *options.shard +
                             "' is not a share of the shards; give I/N, as in 1/8");
        request.share = share->first;
        request.shares = share->second;
        request.whole = false;
    }
    check_places({{"SCENE", options.input}}, {{"-o", options.output}, {"--json", options.json}});
    check_outside(options.output, {{"--json", options.json}});
    make_cache(request);
}

void run_cache(const CLI::App& command, const CacheOptions& options) {
    const auto making = {"--format",          "--isa",    "--shard", "--shard-size", "--shard-frames",
                         "--shard-instances", "--prepare"};
    if (options.verify) {
        refuse_words(command, making, "--verify");
        refuse_words(command, {"--output", "--extract"}, "--verify");
        check_outside(options.input, {{"--json", options.json}});
        return verify_cache(options.input, options.json, usable_threads(options.threads));
    }
    if (options.extract) {
        refuse_words(command, making, "--extract");
        return run_extract(options);
    }
    if (options.prepare) refuse_words(command, {"--shard"}, "--prepare");
    run_make(options);
}

void add_shape_words(CLI::App& command, CacheOptions& options) {
    constexpr std::uint64_t least = 1;
    command
        .add_option("--format", options.format,
                    "Keep positions (3 floats a vertex), packed (position and normal in 12 bytes), or poses, "
                    "from which a reader deforms the bodies (default: positions)")
        ->check(CLI::IsMember({"positions", "packed", "poses"}));
    command.add_option("--isa", options.isa,
                       "Use these kernels: auto, scalar, sse4.2, avx2, avx512, neon (default: auto)");
    command
        .add_option("--shard-size", options.shard_size,
                    "Make shards no larger than this, as 64M or 1G; a shard has at least one instance in "
                    "one frame (default: 256 MiB)")
        ->transform(size_word())
        ->check(CLI::Range(least, most_shard_bytes))
        ->type_name("SIZE");
    command.add_option("--shard-frames", options.shard_frames, "Put this many frames into a shard")
        ->check(CLI::Range(least, most_frames));
    command
        .add_option("--shard-instances", options.shard_instances,
                    "Put at most this many instances into a shard")
        ->check(CLI::Range(least, most_instances));
}

}  // namespace

void add_cache(CLI::App& app, Action& action) {
    const auto options = std::make_shared<CacheOptions>();
    CLI::App* command = app.add_subcommand(
        "cache", "Bake a crowd over time to files, in shards that several machines can share");
    command->footer(
        "A scene is {\"version\": 1, \"fps\": 24, \"frames\": 48,\n"
        "\"bodies\": {\"worm\": {\"file\": \"worm.glb\"}},\n"
        "\"motions\": {\"sway\": {\"swing\": 60, \"seconds\": 2}},\n"
        "\"instances\": [{\"body\": \"worm\", \"motion\": \"sway\", \"grid\": [10, 10], \"spacing\": [3, "
        "3]}]}.\n"
        "samples/farm/README.md has all of its fields, and the format of the files.\n\n"
        "Shards that are there and whole are kept. Options that are left out are those that the folder was\n"
        "made with.");
    command->add_option("input", options->input, "Scene: JSON; with --verify or --extract the cache's folder")
        ->required();
    command->add_option(
        "-o,--output", options->output,
        "Write the cache into this folder; with --extract a model: .glb, .gltf, .obj, .ply or .stl");
    add_shape_words(*command, *options);
    command->add_option("--shard", options->shard,
                        "Bake the I-th of N shares of the shards alone, as 1/8, and no manifest");
    command->add_flag("--prepare", options->prepare, "Bind the bodies and write the plan, but no shard");
    command->add_flag("--verify", options->verify,
                      "Read the whole cache; one line for each fault, and exit code 1 if there is any");
    command->add_option("--extract", options->extract, "Write instance I in frame F as a model: F,I");
    add_threads_word(*command, options->threads);
    add_load_words(*command, options->load);
    add_json_word(*command, options->json);
    command->callback(
        [options, command, &action] { action = [options, command] { run_cache(*command, *options); }; });
}

}  // namespace goffer::cli
