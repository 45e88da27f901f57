// SPDX-License-Identifier: MIT
#include "cache/bodies.hpp"

#include "arguments.hpp"
#include "body_file.hpp"
#include "cache/members.hpp"
#include "poses.hpp"

#include <goffer/io/error.hpp>
#include <goffer/io/read_file.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>

namespace goffer::cli {
namespace {

/// The words of the command line for how a model is bound, which a scene says as fields: fold_length stands
/// for --fold-length.
class BindMembers {
public:
    BindMembers() {
        parser_.add_option("--regions", pose_.regions);
        add_bind_words(parser_, words_);
        add_refine_word(parser_, words_, "auto");
    }

    BindRequest request(const Members& fields, const nlohmann::json& options, const mesh::LoadOptions& load) {
        const std::string& where = fields.place();
        std::vector<std::string> arguments;
        for (const auto& [name, value] : options.items())
            arguments.push_back(word_of(fields, name) + "=" + text_of(fields, name, value));
        try {
            parser_.parse(arguments);
        } catch (const CLI::ParseError& error) {
            throw InputError(where + ": " + error.what());
        }
        words_.load = load;
        BindRequest request = BindRequest(words_, PoseRequest(pose_, words_.fit.arcs).regions).with_one_arc();
        request.with_uvs = true;
        return request;
    }

private:
    /// What is read, and how much of it, is for whoever calls the command to say.
    [[nodiscard]] std::string word_of(const Members& fields, const std::string& name) const {
        std::string word = "--" + name;
        std::ranges::replace(word, '_', '-');
        const bool known = parser_.get_option_no_throw(word) != nullptr;
        if (!known || word == "--allow-outside" || word == "--max-memory" || word == "--help")
            fields.refuse(io::escaped(name),
                          "is not an option of how a model is bound; see goffer bake --help");
        return word;
    }

    static std::string text_of(const Members& fields, const std::string& name, const nlohmann::json& value) {
        if (value.is_string()) return value.get<std::string>();
        if (value.is_number() || value.is_boolean()) return value.dump();
        std::string list;
        for (const nlohmann::json& part : value) {
            if (!value.is_array() || !part.is_number()) fields.refuse(name, "is not a list of numbers");
            list.append(list.empty() ? "" : ",").append(part.dump());
        }
        if (list.empty()) fields.refuse(name, "is not a text, a number, or a list of numbers");
        return list;
    }

    CLI::App parser_;
    BindWords words_;
    PoseWords pose_;
};

}  // namespace

std::string body_bytes(const Scene& scene, const SceneBody& body, const mesh::LoadOptions& options) {
    const Members fields(body.options, io::about(scene.file, "bodies." + body.name));
    const std::string& where = fields.place();
    if (is_body_file(body.file)) {
        fields.allow({"file", "level"});  // the others were decided when it was baked
        if (io::size_of_file(body.file) > options.limits.memory / 4)  // as read_body_file() has it
            throw InputError(io::about(body.file, "takes more than the " +
                                                      io::size_text(options.limits.memory) +
                                                      " of memory that are allowed; allow more with "
                                                      "--max-memory"));
        return io::read_file(body.file);
    }
    if (body.level > 0) fields.refuse("level", "is of no use for a model, which has no levels");
    try {
        BindMembers words;
        const BindRequest request = words.request(fields, body.options, options);
        const std::vector<std::byte> bytes = baked_bytes(bind_model(body.file, request), request);
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    } catch (const UsageError& error) {
        throw InputError(where + ": " + error.what());
    }
}

}  // namespace goffer::cli
