#error "This room does not know OpenGL: only gl, render and the threads above them do."
