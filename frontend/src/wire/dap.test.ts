import { describe, expect, it } from "vitest";
import { DapClient, type DebugProtocol } from "./dap";

function connected(open = true) {
  const sent: DebugProtocol.Request[] = [];
  const client = new DapClient((message) => {
    sent.push(message);
    return open;
  });
  return { client, sent };
}

const answer = (request_seq: number, success: boolean, rest: object = {}) => ({
  seq: 1,
  type: "response",
  request_seq,
  command: "evaluate",
  success,
  ...rest,
});

describe("a DAP client", () => {
  it("resolves each request with the body of its own response", async () => {
    const { client, sent } = connected();
    const first = client.request("evaluate", { expression: "a" });
    const second = client.request("evaluate", { expression: "b" });
    client.receive(answer(sent[1]?.seq ?? 0, true, { body: { result: "2" } }));
    client.receive(answer(sent[0]?.seq ?? 0, true, { body: { result: "1" } }));
    expect(await first).toEqual({ result: "1" });
    expect(await second).toEqual({ result: "2" });
  });

  it("says why a request was refused, with the variables filled in", async () => {
    const { client, sent } = connected();
    const asked = client.request("setVariable");
    const error = { id: 1, format: "{value} is outside of {range}", variables: { value: "9", range: "0..3" } };
    client.receive(answer(sent[0]?.seq ?? 0, false, { message: "refused", body: { error } }));
    await expect(asked).rejects.toThrow("9 is outside of 0..3");
  });

  it("rejects pending requests when the connection is lost", async () => {
    await expect(connected(false).client.request("threads")).rejects.toThrow();
    const { client } = connected();
    const asked = client.request("threads");
    client.abandon();
    await expect(asked).rejects.toThrow();
  });

  it("passes events to their listeners", () => {
    const { client } = connected();
    const heard: unknown[] = [];
    client.on("stopped", (body) => heard.push(body));
    client.receive({ seq: 1, type: "event", event: "stopped", body: { reason: "step" } });
    client.receive({ seq: 2, type: "event", event: "continued", body: {} });
    expect(heard).toEqual([{ reason: "step" }]);
  });
});
