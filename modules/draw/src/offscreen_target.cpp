// SPDX-License-Identifier: MIT
#include <goffer/draw/offscreen.hpp>

#include <epoxy/gl.h>

namespace goffer::draw {

OffscreenTarget::OffscreenTarget(int width, int height) {
    glGenRenderbuffers(2, buffers_.data());
    glBindRenderbuffer(GL_RENDERBUFFER, buffers_[0]);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
    glBindRenderbuffer(GL_RENDERBUFFER, buffers_[1]);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width, height);
    glGenFramebuffers(1, &frame_);
    glBindFramebuffer(GL_FRAMEBUFFER, frame_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers_[0]);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers_[1]);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
    glDeleteFramebuffers(1, &frame_);
    glDeleteRenderbuffers(2, buffers_.data());
    throw Error("OpenGL has no frame buffer of " + std::to_string(width) + " x " + std::to_string(height) +
                " pixels; use a smaller picture");
}

OffscreenTarget::~OffscreenTarget() {
    glDeleteFramebuffers(1, &frame_);
    glDeleteRenderbuffers(2, buffers_.data());
}

void OffscreenTarget::finish() {
    glFinish();
}

}  // namespace goffer::draw
