import { describe, expect, it } from "vitest";
import { isBrokenLink, isOwnComputer, linkPath, readLink, wayTo } from "./links";

const at = (pathname: string, search = "") => ({ pathname, search });

describe("links", () => {
  it("contain an instance, a scan, a panel", () => {
    expect(readLink(at("/i/3/scan/4711", "?panel=watch"))).toEqual({ instance: 3, scan: 4711, panel: "watch" });
    expect(readLink(at("/i/3"))).toEqual({ instance: 3, scan: null, panel: null });
    expect(readLink(at("/i/3/", "?panel=&token=x"))).toEqual({ instance: 3, scan: null, panel: null });
    expect(readLink(at("/"))).toBeNull();
  });

  it("use the word for the verification", () => {
    expect(readLink(at("/i/1/scan/2", "?panel=verification"))?.panel).toBe("verify");
    expect(linkPath({ instance: 1, scan: 2, panel: "verify" })).toBe("/i/1/scan/2?panel=verification");
  });

  it("are read back as they were written", () => {
    for (const link of [
      { instance: 12, scan: 0, panel: "trace" },
      { instance: 1, scan: null, panel: null },
      { instance: 1, scan: 5, panel: "a&b" },
    ]) {
      const { pathname, search } = new URL(linkPath(link), "http://x");
      expect(readLink({ pathname, search })).toEqual(link);
    }
  });

  it("know the hosts that would lead a colleague to their own computer", () => {
    expect(["localhost", "127.0.0.1", "[::1]", "plc.localhost"].filter(isOwnComputer)).toHaveLength(4);
    expect(["bench", "192.168.0.127", "127.example.org", "localhost.lan", "[fe80::1]"].filter(isOwnComputer)).toEqual(
      [],
    );
  });

  it("distinguish a broken link from no link", () => {
    expect(isBrokenLink(at("/i/x/scan/3"))).toBe(true);
    expect(isBrokenLink(at("/i/3/scan/-1"))).toBe(true);
    expect(isBrokenLink(at("/i/3/scan/1"))).toBe(false);
    expect(isBrokenLink(at("/"))).toBe(false);
  });
});

describe("following a link to a scan", () => {
  const now = { first: 10, live: 100, past: null, others: 0 };

  it("goes there when nobody else looks at the PLC, asks when somebody does", () => {
    expect(wayTo(50, now)).toBe("go");
    expect(wayTo(50, { ...now, others: 1 })).toBe("ask");
  });

  it("does nothing when that scan is shown already", () => {
    expect(wayTo(50, { ...now, past: 50, others: 2 })).toBe("there");
    expect(wayTo(50, { ...now, past: 51, others: 2 })).toBe("ask");
  });

  it("checks which scans exist", () => {
    expect(wayTo(9, now)).toBe("outside");
    expect(wayTo(101, now)).toBe("outside");
    expect(wayTo(10, now)).toBe("go");
    expect(wayTo(100, now)).toBe("go");
  });
});
