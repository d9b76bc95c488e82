import { afterEach, describe, expect, it, vi } from "vitest";
import { NoConnection, Refused, rest, sayNoConnection } from "./rest";

const answers = (fetched: () => Promise<Response>) => vi.stubGlobal("fetch", fetched);

describe("a request without an answer", () => {
  afterEach(() => vi.unstubAllGlobals());

  it("is reported in plain words, with whether it may have had an effect", async () => {
    sayNoConnection((reading) => (reading ? "look later" : "not known"));
    answers(() => Promise.reject(new TypeError("Failed to fetch")));
    await expect(rest.models()).rejects.toThrow(new NoConnection(true));
    await expect(rest.models()).rejects.toThrow("look later");
    await expect(rest.deleteFile(1, "Main.st")).rejects.toThrow("not known");
  });

  it("may end in the middle of the answer", async () => {
    const broken = () => new ReadableStream({ start: (stream) => stream.error(new TypeError("network error")) });
    answers(() => Promise.resolve(new Response(broken())));
    await expect(rest.models()).rejects.toThrow(NoConnection);
    await expect(rest.exportUserErrors(1)).rejects.toThrow(NoConnection);
  });

  it("differs from a refusal and from a cancelled request", async () => {
    answers(() => Promise.resolve(Response.json({ message: "why", near: [] }, { status: 422 })));
    await expect(rest.models()).rejects.toThrow(Refused);
    answers(() => Promise.reject(new DOMException("given up", "AbortError")));
    await expect(rest.models()).rejects.toThrow("given up");
  });
});
