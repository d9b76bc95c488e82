/** What there is to request, and what it is answered with: the shapes that are generated, so that the server for tests has the same. */
import type { paths } from "../wire/messages.gen";

/** A path as a test writes it: a star for each parameter, two for the path of a file, which has any number of parts. */
type Starred<P> = P extends `${infer Before}{path}`
  ? `${Starred<Before>}**`
  : P extends `${infer Before}{${string}}${infer After}`
    ? `${Before}*${Starred<After>}`
    : P;

type Api = { [P in keyof paths as P extends `/api${infer Below}` ? Starred<Below> : never]: paths[P] };

export type Method = "GET" | "POST" | "PUT" | "PATCH" | "DELETE";

type Operation<M extends Method, P extends keyof Api> = Api[P][Lowercase<M>];

/** The paths that can be requested with a method. */
export type PathOf<M extends Method> = {
  [P in keyof Api]: Operation<M, P> extends { responses: unknown } ? P : never;
}[keyof Api];

type Content<T> = T extends { content: { "application/json": infer Shape } } ? Shape : undefined;

/** The shape of what is sent with a request. */
export type BodyOf<M extends Method, P extends PathOf<M>> =
  Operation<M, P> extends { requestBody?: infer Body } ? Content<Body> : never;

/** The shape of the answer to a request that is not refused; nothing is an empty answer. */
export type AnswerOf<M extends Method, P extends PathOf<M>> =
  Operation<M, P> extends { responses: infer R } ? Content<R[keyof R & (200 | 201 | 204)]> : never;
