#pragma once
// The OpenGL functions that the executor calls, as a table that eglGetProcAddress fills.

#include <GL/glcorearb.h>

namespace taut::opengl {

// name, and the middle of the pointer type in glcorearb.h
#define TAUT_GL_FUNCTIONS(X)                                                                                 \
    X(GetError, GETERROR)                                                                                    \
    X(GetString, GETSTRING)                                                                                  \
    X(GetStringi, GETSTRINGI)                                                                                \
    X(GetIntegerv, GETINTEGERV)                                                                              \
    X(GetInteger64v, GETINTEGER64V)                                                                          \
    X(GetIntegeri_v, GETINTEGERI_V)                                                                          \
    X(GetGraphicsResetStatus, GETGRAPHICSRESETSTATUS)                                                        \
    X(Enable, ENABLE)                                                                                        \
    X(DebugMessageCallback, DEBUGMESSAGECALLBACK)                                                            \
    X(CreateBuffers, CREATEBUFFERS)                                                                          \
    X(DeleteBuffers, DELETEBUFFERS)                                                                          \
    X(IsBuffer, ISBUFFER)                                                                                    \
    X(NamedBufferStorage, NAMEDBUFFERSTORAGE)                                                                \
    X(NamedBufferSubData, NAMEDBUFFERSUBDATA)                                                                \
    X(GetNamedBufferSubData, GETNAMEDBUFFERSUBDATA)                                                          \
    X(ClearNamedBufferData, CLEARNAMEDBUFFERDATA)                                                            \
    X(BindBuffer, BINDBUFFER)                                                                                \
    X(BindBufferRange, BINDBUFFERRANGE)                                                                      \
    X(CreateShader, CREATESHADER)                                                                            \
    X(DeleteShader, DELETESHADER)                                                                            \
    X(ShaderSource, SHADERSOURCE)                                                                            \
    X(CompileShader, COMPILESHADER)                                                                          \
    X(ShaderBinary, SHADERBINARY)                                                                            \
    X(GetShaderiv, GETSHADERIV)                                                                              \
    X(GetShaderInfoLog, GETSHADERINFOLOG)                                                                    \
    X(CreateProgram, CREATEPROGRAM)                                                                          \
    X(DeleteProgram, DELETEPROGRAM)                                                                          \
    X(AttachShader, ATTACHSHADER)                                                                            \
    X(LinkProgram, LINKPROGRAM)                                                                              \
    X(GetProgramiv, GETPROGRAMIV)                                                                            \
    X(GetProgramInfoLog, GETPROGRAMINFOLOG)                                                                  \
    X(GetProgramResourceIndex, GETPROGRAMRESOURCEINDEX)                                                      \
    X(GetProgramResourceiv, GETPROGRAMRESOURCEIV)                                                            \
    X(GetUniformIndices, GETUNIFORMINDICES)                                                                  \
    X(GetActiveUniformsiv, GETACTIVEUNIFORMSIV)                                                              \
    X(UseProgram, USEPROGRAM)                                                                                \
    X(DispatchCompute, DISPATCHCOMPUTE)                                                                      \
    X(DispatchComputeIndirect, DISPATCHCOMPUTEINDIRECT)                                                      \
    X(MemoryBarrier, MEMORYBARRIER)                                                                          \
    X(Flush, FLUSH)                                                                                          \
    X(FenceSync, FENCESYNC)                                                                                  \
    X(ClientWaitSync, CLIENTWAITSYNC)                                                                        \
    X(DeleteSync, DELETESYNC)                                                                                \
    X(CreateQueries, CREATEQUERIES)                                                                          \
    X(DeleteQueries, DELETEQUERIES)                                                                          \
    X(QueryCounter, QUERYCOUNTER)                                                                            \
    X(GetQueryiv, GETQUERYIV)                                                                                \
    X(GetQueryObjectui64v, GETQUERYOBJECTUI64V)

struct Gl
{
#define TAUT_GL_MEMBER(name, type) PFNGL##type##PROC name = nullptr;
    TAUT_GL_FUNCTIONS(TAUT_GL_MEMBER)
#undef TAUT_GL_MEMBER
    /// Core in 4.6, else from GL_ARB_gl_spirv; null where SPIR-V is not taken.
    PFNGLSPECIALIZESHADERPROC SpecializeShader = nullptr;
};

} // namespace taut::opengl
