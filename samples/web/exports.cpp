// SPDX-License-Identifier: MIT
// The viewer in a browser: what page.js calls. Texts go in and out as JSON; a text that comes out is good
// until the next call. Nothing throws: an answer with "error" says what was wrong.
#include "page.hpp"

#include <emscripten/emscripten.h>

#include <exception>
#include <new>

namespace goffer::web {
namespace {

/// What `work` returns, as text that `page` keeps; or what it throws.
template <class Work>
const char* answered(Page& page, const Work& work) {
    try {
        try {
            page.answer = Json(work()).dump(-1, ' ', false, Json::error_handler_t::replace);
        } catch (const std::bad_alloc&) {
            page.answer = R"({"error": "not enough memory for this; use a smaller file"})";
        } catch (const std::exception& error) {
            page.answer = Json{{"error", error.what()}}.dump(-1, ' ', false, Json::error_handler_t::replace);
        }
        return page.answer.c_str();
    } catch (...) {
        return R"({"error": "not enough memory for this; use a smaller file"})";
    }
}

template <class Work>
const char* then_state(Page& page, const Work& work) {
    return answered(page, [&] {
        work();
        return page.state();
    });
}

}  // namespace
}  // namespace goffer::web

using goffer::web::Page;

extern "C" {

EMSCRIPTEN_KEEPALIVE Page* goffer_page_make() {
    return new (std::nothrow) Page;
}

/// On the canvas that a selector finds. After an error the page is good for nothing.
EMSCRIPTEN_KEEPALIVE const char* goffer_page_start(Page* page, const char* canvas) {
    return goffer::web::then_state(*page, [&] { page->start(canvas); });
}

EMSCRIPTEN_KEEPALIVE const char* goffer_page_state(Page* page) {
    return goffer::web::then_state(*page, [] {});
}

EMSCRIPTEN_KEEPALIVE const char* goffer_page_open(Page* page, const char* files) {
    return goffer::web::then_state(*page, [&] { page->open(goffer::web::Json::parse(files)); });
}

EMSCRIPTEN_KEEPALIVE const char* goffer_page_bind(Page* page, const char* words) {
    return goffer::web::then_state(*page, [&] { page->bind(goffer::web::Json::parse(words)); });
}

EMSCRIPTEN_KEEPALIVE const char* goffer_page_crowd(Page* page, int instances) {
    return goffer::web::then_state(*page, [&] { page->set_instances(instances); });
}

EMSCRIPTEN_KEEPALIVE const char* goffer_page_bend(Page* page, int region, float angle, float direction) {
    return goffer::web::then_state(*page, [&] {
        page->set_bend(static_cast<std::size_t>(region), {angle, direction});
    });
}

EMSCRIPTEN_KEEPALIVE const char* goffer_page_drag(Page* page, int region, float x, float y) {
    return goffer::web::then_state(*page, [&] { page->drag(static_cast<std::size_t>(region), {x, y}); });
}

EMSCRIPTEN_KEEPALIVE const char* goffer_page_show(Page* page, const char* what) {
    return goffer::web::then_state(*page, [&] { page->show(goffer::web::Json::parse(what)); });
}

EMSCRIPTEN_KEEPALIVE const char* goffer_page_save(Page* page) {
    return goffer::web::answered(*page, [&] { return goffer::web::Json{{"file", page->save()}}; });
}

EMSCRIPTEN_KEEPALIVE const char* goffer_page_command(Page* page) {
    return goffer::web::answered(*page, [&] { return goffer::web::Json{{"command", page->command()}}; });
}

/// The region whose end is at a place of the picture, -1 to 1 from edge to edge; or -1.
EMSCRIPTEN_KEEPALIVE int goffer_page_end_at(Page* page, float x, float y, float reach) {
    return page->end_at({x, y}, reach);
}

/// {"set_up", "deform", "upload"} in milliseconds.
EMSCRIPTEN_KEEPALIVE const char* goffer_page_draw(Page* page, int width, int height, int frame,
                                                  int animated) {
    return goffer::web::answered(*page, [&] {
        const goffer::cli::FrameTimes times =
            page->draw(width, height, static_cast<std::size_t>(frame), animated != 0);
        return goffer::web::Json{
            {"set_up", times.set_up}, {"deform", times.deform}, {"upload", times.upload}};
    });
}

EMSCRIPTEN_KEEPALIVE void goffer_page_orbit(Page* page, float azimuth, float elevation) {
    page->camera().orbit(azimuth, elevation);
}
EMSCRIPTEN_KEEPALIVE void goffer_page_pan(Page* page, float x, float y) {
    page->camera().pan({x, y});
}
EMSCRIPTEN_KEEPALIVE void goffer_page_zoom(Page* page, float factor) {
    page->camera().zoom(factor);
}
EMSCRIPTEN_KEEPALIVE const char* goffer_page_look(Page* page) {
    return goffer::web::then_state(*page, [&] { page->look(); });
}

}  // extern "C"
