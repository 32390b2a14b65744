// What collide/face.comp says of a triangle; read by face_move and by the host.
#ifndef TAUT_SHARED_FACE_STATE_H
#define TAUT_SHARED_FACE_STATE_H

#define TAUT_FACE_FAR 0u    // no collider comes near in this time step
#define TAUT_FACE_NEAR 1u   // one may, but was not in the way in this substep's first sweep
#define TAUT_FACE_PUSHED 2u // one was: its slots say where its corners go
#define TAUT_FACE_FREE 3u   // one was in an earlier sweep of the substep

#endif
