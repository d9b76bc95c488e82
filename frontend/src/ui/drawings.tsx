/** The drawings of the icons, by a simple grammar: filled is true now, hollow is not now, dashed is never. */
export const drawings = {
  logo: (
    <>
      <path d="M2.75 5.5v-1a1.75 1.75 0 0 1 1.75-1.75h7a1.75 1.75 0 0 1 1.75 1.75v1M2.75 10.5v1a1.75 1.75 0 0 0 1.75 1.75h7a1.75 1.75 0 0 0 1.75-1.75v-1" />
      <path d="M.9 8h3.6l1.3-2.2 2 4.6L9.4 8h5.7" />
    </>
  ),
  play: <path d="M5 3.4v9.2L12.4 8z" className="f" />,
  pause: <path d="M5.5 3.5v9M10.5 3.5v9" />,
  scan: (
    <>
      <path d="M13.25 8A5.25 5.25 0 1 1 11.5 4.1M11.75 1.75v2.6h-2.6" />
      <circle cx="8" cy="8" r="1.25" className="f" />
    </>
  ),
  running: (
    <>
      <circle cx="8" cy="8" r="5.75" />
      <path d="M6.6 5.6v4.8L10.6 8z" className="f" />
    </>
  ),
  halted: (
    <>
      <circle cx="8" cy="8" r="5.75" />
      <path d="M6.5 5.9v4.2M9.5 5.9v4.2" />
    </>
  ),
  stopped: (
    <>
      <circle cx="8" cy="8" r="5.75" />
      <rect x="5.9" y="5.9" width="4.2" height="4.2" className="f" />
    </>
  ),
  fatal: (
    <>
      <path d="M5.5 2.25h5l3.25 3.25v5l-3.25 3.25h-5L2.25 10.5v-5z" />
      <path d="M8 4.9v3.6" />
      <circle cx="8" cy="11" r=".9" className="f" />
    </>
  ),
  lost: (
    <path d="M6.2 4.4 7.4 3.2a3.1 3.1 0 0 1 4.4 4.4l-1.2 1.2M9.8 11.6l-1.2 1.2a3.1 3.1 0 0 1-4.4-4.4l1.2-1.2M2 2l12 12" />
  ),
  forced: (
    <>
      <rect x="3.5" y="7.25" width="9" height="6" rx="1" />
      <path d="M5.5 7V5a2.5 2.5 0 0 1 5 0v2" />
    </>
  ),
  unforce: (
    <>
      <rect x="3.5" y="7.25" width="9" height="6" rx="1" />
      <path d="M5.5 7V4.75a2.5 2.5 0 0 1 4.8-.9" />
    </>
  ),
  changed: <path d="M8 3.5 13 12.5H3z" className="f" />,
  never: <circle cx="8" cy="8" r="5" strokeDasharray="2.1 2.4" />,
  generated: <path d="M9 1.75 3.75 9h3.6L7 14.25 12.25 7h-3.6z" className="f" />,
  cleared: <path d="M9 1.75 3.75 9h3.6L7 14.25 12.25 7h-3.6z" strokeWidth="1.25" />,
  handled: <path d="M8 1.9 13 3.6v4c0 3-2 5.4-5 6.5-3-1.1-5-3.5-5-6.5v-4zM5.75 8l1.6 1.6 3-3.2" />,
  noeffect: (
    <>
      <path d="M1.75 8S4 3.9 8 3.9 14.25 8 14.25 8 12 12.1 8 12.1 1.75 8 1.75 8z" />
      <circle cx="8" cy="8" r="1.75" />
    </>
  ),
  unhandled: (
    <path d="M4.4 4.9C2.7 6.1 1.75 8 1.75 8S4 12.1 8 12.1c1.2 0 2.3-.4 3.2-.9M7 4c.3-.1.7-.1 1-.1 4 0 6.25 4.1 6.25 4.1s-.6 1.1-1.7 2.1M2.5 2.5l11 11" />
  ),
  decided: <path d="M8 14V9.5M8 9.5 3.75 5.25M8 9.5l4.25-4.25M3.75 8.25v-3h3M12.25 8.25v-3h-3" />,
  displayed: (
    <>
      <rect x="1.75" y="3" width="12.5" height="8" rx="1" />
      <path d="M5.5 13.5h5M4.25 8.5h3M4.25 5.75h5.5" />
    </>
  ),
  stored: <path d="M8 2v6m-2.5-2.5L8 8l2.5-2.5M2.5 9v4.5h11V9h-3L9.5 11h-3L5.5 9z" />,
  notreached: <path d="M2 8h6.5M6 5.5 8.5 8 6 10.5M11 3v2M11 7v2M11 11v2M13.5 3v10" />,
  "chev-r": <path d="m6.25 4.5 3.5 3.5-3.5 3.5" />,
  "chev-d": <path d="M4.5 6.25 8 9.75l3.5-3.5" />,
  "chev-u": <path d="M4.5 9.75 8 6.25l3.5 3.5" />,
  search: (
    <>
      <circle cx="7" cy="7" r="4.25" />
      <path d="m10.2 10.2 3.3 3.3" />
    </>
  ),
  plus: <path d="M8 3.25v9.5M3.25 8h9.5" />,
  minus: <path d="M3.5 8h9" />,
  equal: <path d="M3.5 6.25h9M3.5 9.75h9" />,
  x: <path d="m4.25 4.25 7.5 7.5M11.75 4.25l-7.5 7.5" />,
  check: <path d="m3.25 8.5 3 3 6.5-7" />,
  more: (
    <>
      <circle cx="3.5" cy="8" r="1.2" className="f" />
      <circle cx="8" cy="8" r="1.2" className="f" />
      <circle cx="12.5" cy="8" r="1.2" className="f" />
    </>
  ),
  folder: <path d="M2.25 4.25a1 1 0 0 1 1-1h3l1.5 1.75h5a1 1 0 0 1 1 1v5.75a1 1 0 0 1-1 1h-9.5a1 1 0 0 1-1-1z" />,
  program: (
    <>
      <rect x="2.75" y="2.75" width="10.5" height="10.5" rx="1.25" />
      <path d="M6.25 11V5h2.1a1.8 1.8 0 0 1 0 3.6h-2.1" />
    </>
  ),
  fb: (
    <>
      <rect x="4.75" y="2.75" width="6.5" height="10.5" rx="1" />
      <path d="M1.75 5.5h3M1.75 10.5h3M11.25 8h3" />
    </>
  ),
  fn: <path d="M10.8 3.2c-1.7-.6-2.6.3-2.9 2L6.7 11c-.3 1.7-1.2 2.4-2.6 1.8M5.25 6.75h5" />,
  struct: (
    <path d="M6 2.75c-1.5 0-2 .7-2 1.9v1.6c0 1-.4 1.75-1.5 1.75 1.1 0 1.5.75 1.5 1.75v1.6c0 1.2.5 1.9 2 1.9M10 2.75c1.5 0 2 .7 2 1.9v1.6c0 1 .4 1.75 1.5 1.75-1.1 0-1.5.75-1.5 1.75v1.6c0 1.2-.5 1.9-2 1.9" />
  ),
  array: (
    <>
      <path d="M5.5 2.75h-2.25v10.5h2.25M10.5 2.75h2.25v10.5h-2.25" />
      <path d="M6.75 8h2.5" />
    </>
  ),
  var: <path d="M4.5 4.5 8 12l3.5-7.5" />,
  mem: (
    <>
      <rect x="4" y="4" width="8" height="8" rx="1" />
      <path d="M6.5 4V2M9.5 4V2M6.5 14v-2M9.5 14v-2M4 6.5H2M4 9.5H2M14 6.5h-2M14 9.5h-2" />
    </>
  ),
  plc: (
    <>
      <rect x="2.25" y="3.25" width="3.5" height="9.5" />
      <rect x="5.75" y="3.25" width="8" height="9.5" />
      <path d="M8 6h3.5M8 8.25h3.5" />
    </>
  ),
  globe: (
    <>
      <circle cx="8" cy="8" r="5.5" />
      <path d="M2.5 8h11M8 2.5c2 2 2 9 0 11M8 2.5c-2 2-2 9 0 11" />
    </>
  ),
  warning: (
    <>
      <path d="M8 2.5 14 13H2z" />
      <path d="M8 6.5v3" />
      <circle cx="8" cy="11.25" r=".8" className="f" />
    </>
  ),
  error: (
    <>
      <circle cx="8" cy="8" r="5.5" />
      <path d="m6 6 4 4M10 6l-4 4" />
    </>
  ),
  info: (
    <>
      <circle cx="8" cy="8" r="5.5" />
      <path d="M8 7.5v3.25" />
      <circle cx="8" cy="5.25" r=".8" className="f" />
    </>
  ),
  theme: (
    <>
      <circle cx="8" cy="8" r="5.25" />
      <path d="M8 2.75a5.25 5.25 0 0 1 0 10.5z" className="f" />
    </>
  ),
  refresh: <path d="M13.25 8A5.25 5.25 0 1 1 11.5 4.1M11.75 1.75v2.6h-2.6" />,
  eye: (
    <>
      <path d="M1.75 8S4 3.9 8 3.9 14.25 8 14.25 8 12 12.1 8 12.1 1.75 8 1.75 8z" />
      <circle cx="8" cy="8" r="1.75" />
    </>
  ),
  drag: (
    <>
      <circle cx="6" cy="4" r="1" className="f" />
      <circle cx="10" cy="4" r="1" className="f" />
      <circle cx="6" cy="8" r="1" className="f" />
      <circle cx="10" cy="8" r="1" className="f" />
      <circle cx="6" cy="12" r="1" className="f" />
      <circle cx="10" cy="12" r="1" className="f" />
    </>
  ),
  mouse: (
    <>
      <rect x="4.5" y="2" width="7" height="12" rx="3.5" />
      <path d="M8 2v4.5" />
    </>
  ),
  keyboard: (
    <>
      <rect x="1.75" y="4" width="12.5" height="8" rx="1.25" />
      <path d="M4.25 6.5h.01M6.75 6.5h.01M9.25 6.5h.01M11.75 6.5h.01M5 9.5h6" />
    </>
  ),
  users: (
    <>
      <circle cx="6" cy="5.5" r="2.25" />
      <path d="M2 13c0-2.5 1.7-4 4-4s4 1.5 4 4M10.5 3.4a2.25 2.25 0 0 1 0 4.2M12 9.5c1.3.6 2 1.8 2 3.5" />
    </>
  ),
  list: (
    <>
      <path d="M5.75 4h7.5M5.75 8h7.5M5.75 12h7.5" />
      <circle cx="3" cy="4" r=".9" className="f" />
      <circle cx="3" cy="8" r=".9" className="f" />
      <circle cx="3" cy="12" r=".9" className="f" />
    </>
  ),
  layout: (
    <>
      <rect x="2.25" y="2.75" width="11.5" height="10.5" rx="1" />
      <path d="M6 2.75v10.5M6 9.5h7.75" />
    </>
  ),
  wait: (
    <>
      <circle cx="4" cy="8" r="1.1" className="f" />
      <circle cx="8" cy="8" r="1.1" className="f" />
      <circle cx="12" cy="8" r="1.1" className="f" />
    </>
  ),
  clock: (
    <>
      <circle cx="8" cy="8" r="5.5" />
      <path d="M8 4.75V8l2.25 1.5" />
    </>
  ),
  swap: <path d="M3 5.5h9M9.5 3 12 5.5 9.5 8M13 10.5H4M6.5 8 4 10.5 6.5 13" />,
  past: (
    <>
      <path d="M2.75 8a5.25 5.25 0 1 0 1.7-3.85M2.5 2.2v2.9h2.9" />
      <path d="M8 5.2V8l2 1.4" />
    </>
  ),
  branch: (
    <>
      <circle cx="4.5" cy="3.75" r="1.5" />
      <circle cx="4.5" cy="12.25" r="1.5" />
      <circle cx="11.5" cy="5.75" r="1.5" />
      <path d="M4.5 5.25v5.5M11.5 7.25c0 2.2-2 2.5-4 2.75-1.6.2-3 .5-3 .75" />
    </>
  ),
  off: (
    <>
      <path d="M5 3.9a5.25 5.25 0 1 0 6 0" />
      <path d="M8 2v5.5" />
    </>
  ),
  "step-back": <path d="M4.5 3.5v9M12 3.8v8.4L6.3 8z" />,
  until: <path d="M2.5 8h7.5M7 4.75 10.25 8 7 11.25M13 3.25v9.5" />,
  "zoom-in": (
    <>
      <circle cx="7" cy="7" r="4.25" />
      <path d="m10.2 10.2 3.3 3.3M7 5.2v3.6M5.2 7h3.6" />
    </>
  ),
  "zoom-out": (
    <>
      <circle cx="7" cy="7" r="4.25" />
      <path d="m10.2 10.2 3.3 3.3M5.2 7h3.6" />
    </>
  ),
  fit: <path d="M2.5 4v8M13.5 4v8M4.5 8h7M6.25 6 4.5 8l1.75 2M9.75 6l1.75 2-1.75 2" />,
  trash: <path d="M3 4.5h10M6.25 4.5V3h3.5v1.5M4.5 4.5l.6 8.75h5.8l.6-8.75M6.75 7v4M9.25 7v4" />,
  record: (
    <>
      <circle cx="8" cy="8" r="5.25" />
      <circle cx="8" cy="8" r="2.25" className="f" />
    </>
  ),
  trigger: <path d="M2 12h4.5V4H14" />,
  printer: <path d="M4.5 6V2.5h7V6m-7 5.5h-2V6h11v5.5h-2m-7-2h7v4h-7z" />,
  export: <path d="M8 2.25v7.5M5 7l3 3 3-3M2.75 11.5v1.25a1 1 0 0 0 1 1h8.5a1 1 0 0 0 1-1V11.5" />,
  differs: <path d="M3 6h10M3 10h10M10.75 3l-5.5 10" />,
  filter: <path d="M2.5 4h11M4.75 8h6.5M6.75 12h2.5" />,
  sort: <path d="M8 3v10M4.75 9.75 8 13l3.25-3.25" />,
  import: <path d="M8 9.75v-7.5M5 5l3-3 3 3M2.75 11.5v1.25a1 1 0 0 0 1 1h8.5a1 1 0 0 0 1-1V11.5" />,
  moved: <path d="M2.5 8h10.5M9.5 4.5 13 8l-3.5 3.5" />,
  init: (
    <>
      <path d="M4 2.75h5l3 3v7.5H4z" />
      <path d="M8 7v4M6 9h4" />
    </>
  ),
  task: (
    <>
      <circle cx="8" cy="8" r="5.5" />
      <path d="M8 4.75V8l2.25 1.5" />
    </>
  ),
  "step-over": (
    <>
      <path d="M2.5 8.25a5.5 5.5 0 0 1 10-2.6M13 2.5v3.4H9.6" />
      <circle cx="8" cy="12" r="1.5" className="f" />
    </>
  ),
  "step-in": (
    <>
      <path d="M8 1.75v7M4.9 5.9 8 9l3.1-3.1" />
      <circle cx="8" cy="12.75" r="1.5" className="f" />
    </>
  ),
  "step-out": (
    <>
      <path d="M8 9V2M4.9 5 8 1.9 11.1 5" />
      <circle cx="8" cy="12.75" r="1.5" className="f" />
    </>
  ),
  reverse: <path d="M11 3.4v9.2L3.6 8z" className="f" />,
  stack: <path d="m8 2.5 5.5 2.75L8 8 2.5 5.25zM2.5 8 8 10.75 13.5 8M2.5 10.75 8 13.5l5.5-2.75" />,
  bp: <circle cx="8" cy="8" r="4.25" className="f" />,
  "bp-cond": (
    <>
      <circle cx="8" cy="8" r="4.25" className="f" />
      <path d="M6.25 7h3.5M6.25 9.2h3.5" stroke="var(--bg-panel)" strokeWidth="1.25" />
    </>
  ),
  "bp-log": <path d="M8 3 13 8l-5 5-5-5z" className="f" />,
  "bp-assign": <path d="M3.5 3.5h6L13 8l-3.5 4.5h-6z" className="f" />,
  "bp-data": <path d="M8 3.25 12.75 12H3.25z" className="f" />,
  "bp-off": <circle cx="8" cy="8" r="3.75" />,
  "bp-unbound": <circle cx="8" cy="8" r="3.75" strokeDasharray="1.8 1.7" />,
  here: <path d="M2.5 5.25h6V2.75L14 8l-5.5 5.25v-2.5h-6z" />,
  "here-bp": (
    <>
      <path d="M2 4.75h6.5V2L14.75 8 8.5 14v-2.75H2z" />
      <circle cx="6.8" cy="8" r="2.3" className="f" />
    </>
  ),
  bound: <path d="M2.75 3v4.25a1.5 1.5 0 0 0 1.5 1.5h8.5M10 5.75l3 3-3 3" />,
  help: <path d="M5.5 6a2.5 2.5 0 1 1 3.7 2.2c-.75.42-1.2.9-1.2 1.8M8 12.6v.15" />,
  back: <path d="M13 8H3.5M7.25 4 3.25 8l4 4" />,
  forward: <path d="M3 8h9.5M8.75 4l4 4-4 4" />,
  popout: (
    <path d="M6.75 3.75H3.5a.75.75 0 0 0-.75.75v8c0 .41.34.75.75.75h8a.75.75 0 0 0 .75-.75V9.25M9.25 2.75h4v4M13 3 7.75 8.25" />
  ),
  link: (
    <path d="M6.75 9.25a2.6 2.6 0 0 0 3.7 0l2-2a2.6 2.6 0 0 0-3.7-3.7l-.9.9M9.25 6.75a2.6 2.6 0 0 0-3.7 0l-2 2a2.6 2.6 0 0 0 3.7 3.7l.9-.9" />
  ),
  cmd: <path d="m4 5 3 3-3 3M8.5 11.5h4" />,
  disturbance: <path d="M1.25 8h2.5l1.5-4.25 2.75 8.5 2.25-6.5L11.75 8h3" />,
  flip: (
    <path d="M3.75 5.25c1.1 0 1.75 1 1.75 2.75s-.65 2.75-1.75 2.75S2 9.75 2 8s.65-2.75 1.75-2.75zM7.5 8h3.25M9.5 6.6 10.9 8 9.5 9.4M13.5 5.25v5.5" />
  ),
  stuck: <path d="M1.5 11H4V5h2.5v6H9V5h5.5" />,
} as const;

export type IconName = keyof typeof drawings;
