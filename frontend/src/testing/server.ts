/**
 * A server for one test: it speaks over the page's own WebSocket and `fetch`. The test says what the server tells, and sees what the page
 * sent. What a test says nothing about is answered as by an idle PLC: commands are done, lists are empty.
 */
import { messageOf } from "../logic/format/messageOf";
import type { ClientMessage, Hello, Instance, InstanceState, PlcSymbol, Refusal, ServerMessage } from "../wire/types";
import type { AnswerOf, BodyOf, Method, PathOf } from "./api";
import { frameOf } from "./frames";
import { type Question, type Route, Status, usualRoutes } from "./routes";
import { someHello, someInstance, someProject } from "./samples";
import type { FakeSocket } from "./socket";

/** What a command is answered with: nothing is `done`, a text is why not. */
export type Verdict = string | (Refusal & { final?: boolean }) | undefined;

type Message<T extends ClientMessage["type"]> = Extract<ClientMessage, { type: T }>;

type Arguments = Record<string, unknown>;

interface DapRequest {
  seq: number;
  command: string;
  arguments: Arguments;
}

export class FakeServer {
  /** What the page sent over the socket, the newest last. */
  readonly sent: ClientMessage[] = [];
  /** What it asked over HTTP. */
  readonly asked: Question[] = [];
  /** Requests that no route answers: a test with any of them fails. */
  readonly unknown: string[] = [];
  /** The variables and addresses that can be watched. */
  readonly symbols = new Map<string, PlcSymbol>();
  /** The names that are similar to an unknown one. */
  near: string[] = [];
  instance: Instance;
  private readonly routes: [string, RegExp, Route][] = [];
  private readonly verdicts = new Map<string, (command: ClientMessage) => Verdict>();
  private readonly adapter = new Map<string, (args: Arguments) => object>();
  /** What the page is greeted with besides. */
  greeting: Partial<Hello> = {};
  private readonly values = new Map<string, bigint>();
  private readonly ids = new Map<number, string>();
  private nextId = 1;
  private socket: FakeSocket | null = null;

  /** The number of the project and of the PLC: a different one for each test, so that the page forgets the previous test. */
  constructor(id: number) {
    this.instance = someInstance(id, someProject(id));
    usualRoutes(this.on.bind(this), () => this.instance);
  }

  // ---- what a test says ---------------------------------------------------------------------------------------------

  /**
   * What a request is answered with, in the shape of the API; the last route that fits is taken. `path` is below `/api`; a `*` stands for a
   * part of it, `**` for the path of a file.
   */
  on<M extends Method, P extends PathOf<M>>(method: M, path: P, route: Route<BodyOf<M, P>, AnswerOf<M, P>>): void {
    const escaped = path.replace(/[.+?^$()|[\]\\{}]/g, "\\$&");
    const pattern = new RegExp(`^${escaped.replaceAll("**", "([^?&]+)").replaceAll("*", "([^/?&]+)")}(?:\\?.*)?$`);
    this.routes.unshift([method, pattern, (question, match) => route(question as Question<BodyOf<M, P>>, match)]);
  }

  /** What commands of a type are answered with. */
  command<T extends ClientMessage["type"]>(type: T, verdict: (command: Message<T>) => Verdict): void {
    this.verdicts.set(type, (command) => verdict(command as Message<T>));
  }

  /** What a request of the debug adapter protocol is answered with; what is thrown is why not. */
  debug(command: string, body: (args: Arguments) => object): void {
    this.adapter.set(command, body);
  }

  /** Something happened in the debugger. */
  debugEvent(event: string, body: Arguments): void {
    this.say({ type: "dap", message: { seq: 1, type: "event", event, body: JSON.parse(JSON.stringify(body)) } });
  }

  say(message: ServerMessage): void {
    this.socket?.receive(JSON.stringify(message));
  }

  /** The state of the PLC changes. */
  becomes(change: Partial<InstanceState>): void {
    this.instance = { ...this.instance, state: { ...this.instance.state, ...change } };
    this.say({ type: "state", state: this.instance.state });
  }

  /** There is a variable or an address; `value` are its bytes as a whole number. */
  has(symbol: PlcSymbol, value: number | bigint | boolean = 0): void {
    this.symbols.set(symbol.path, symbol);
    this.values.set(symbol.path, BigInt(value));
  }

  /** A variable has a new value from the next scan on. */
  set(path: string, value: number | bigint | boolean): void {
    this.values.set(path, BigInt(value));
    this.sendFrame([...this.ids].filter(([, watched]) => watched === path).map(([id]) => id));
  }

  /** Scans go by in which no value changes that somebody watches. */
  runsTo(scan: number): void {
    this.instance = { ...this.instance, state: { ...this.instance.state, scan } };
    this.socket?.receive(frameOf(new Map(), scan, this.instance.state.time_ns));
  }

  /** The connection breaks, and the server stays away until a socket is opened again. */
  hangUp(): void {
    this.socket?.break();
  }

  // ---- what a test sees ---------------------------------------------------------------------------------------------

  /** The messages of one type that the page sent. */
  sentOf<T extends ClientMessage["type"]>(type: T): Message<T>[] {
    return this.sent.filter((message): message is Message<T> => message.type === type);
  }

  /** The arguments of the requests of one kind to the debug adapter. */
  debugged(command: string): Arguments[] {
    const requests = this.sentOf("dap").map(({ message }) => requestIn(message));
    return requests.filter((request) => request.command === command).map((request) => request.arguments);
  }

  /** The bodies of what was asked of a route. */
  askedOf(method: string, path: string): unknown[] {
    return this.asked.filter((one) => one.method === method && one.path === path).map(({ body }) => body);
  }

  // ---- the page's side ----------------------------------------------------------------------------------------------

  opened(socket: FakeSocket): void {
    this.socket = socket;
    this.ids.clear();
    this.say({ ...someHello(this.instance), ...this.greeting });
  }

  heard(text: string, socket: FakeSocket): void {
    if (socket !== this.socket) return;
    const message = JSON.parse(text) as ClientMessage;
    this.sent.push(message);
    // As over a network: the answer is not there when the page has hardly said it.
    queueMicrotask(() => this.answer(message));
  }

  readonly fetch = async (address: string, init: RequestInit = {}): Promise<Response> => {
    const question = {
      method: init.method ?? "GET",
      path: address.replace(/^\/api/, ""),
      body: typeof init.body === "string" ? JSON.parse(init.body) : init.body,
    };
    this.asked.push(question);
    for (const [method, pattern, route] of this.routes) {
      const match = method === question.method ? pattern.exec(question.path) : null;
      if (match) return responseOf(await route(question, match));
    }
    this.unknown.push(`${question.method} ${question.path}`);
    return responseOf(new Status(404, { message: "the test has no such route", near: [] }));
  };

  private answer(message: ClientMessage): void {
    if (message.type === "watch") this.watch(message);
    else if (message.type === "unwatch") for (const id of message.ids) this.ids.delete(id);
    else if (message.type === "here") return;
    else if (message.type === "dap") this.debugAnswer(requestIn(message.message));
    else {
      const verdict = this.verdicts.get(message.type)?.(message);
      const refused = typeof verdict === "object" ? verdict : { message: verdict ?? "" };
      const { message: why, near = [], final = false } = refused;
      this.say({ type: "done", ref: message.ref, ok: verdict === undefined, message: why, near, final, scan: null });
    }
  }

  private debugAnswer({ seq, command, arguments: args }: DapRequest): void {
    const response = { seq, type: "response", request_seq: seq, command };
    try {
      const body = this.adapter.get(command)?.(args) ?? {};
      this.say({ type: "dap", message: { ...response, success: true, body: JSON.parse(JSON.stringify(body)) } });
    } catch (error) {
      this.say({ type: "dap", message: { ...response, success: false, message: messageOf(error) } });
    }
  }

  private watch({ ref, paths }: Message<"watch">): void {
    const items = paths.map((path) => {
      const symbol = this.symbols.get(path) ?? null;
      if (!symbol) return { path, id: null, symbol, refusal: { message: `${path} is not known`, near: this.near } };
      this.nextId += 1;
      this.ids.set(this.nextId, path);
      return { path, id: this.nextId, symbol, refusal: null };
    });
    this.say({ type: "watching", ref, items });
    this.sendFrame(items.flatMap(({ id }) => id ?? []));
  }

  private sendFrame(ids: readonly number[]): void {
    const values = new Map(ids.map((id) => [id, this.values.get(this.ids.get(id) ?? "") ?? 0n]));
    const { scan, time_ns } = this.instance.state;
    if (values.size > 0) this.socket?.receive(frameOf(values, scan, time_ns));
  }
}

function responseOf(answer: unknown): Response {
  if (answer instanceof Response) return answer;
  if (answer === undefined) return new Response(null, { status: 204 });
  if (answer instanceof Status) return new Response(JSON.stringify(answer.body), { status: answer.status });
  return new Response(JSON.stringify(answer));
}

function requestIn({ seq, command, arguments: args }: Record<string, unknown>): DapRequest {
  return { seq: Number(seq), command: String(command), arguments: { ...Object(args) } };
}
