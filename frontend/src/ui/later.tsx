import { type ComponentType, useEffect, useState } from "react";
import { t } from "../text";

type Load<P> = () => Promise<{ default: ComponentType<P> }>;

/** A component whose code is loaded when it is first shown. Without a connection it says so, and tries again until the code is there:
 * `React.lazy` would try once, and fail for good. */
export function later<P extends object>(load: Load<P>): ComponentType<P> {
  let loaded: ComponentType<P> | null = null;
  return function Later(props: P) {
    const [View, setView] = useState(() => loaded);
    const [failures, setFailures] = useState(0);
    useEffect(() => {
      if (View) return;
      let shown = true;
      const attempt = async () => {
        try {
          await stylesAgain();
          loaded = (await load()).default;
          if (shown) setView(() => loaded);
        } catch {
          if (shown) setFailures(failures + 1);
        }
      };
      const timer = setTimeout(attempt, delay(failures));
      return () => {
        shown = false;
        clearTimeout(timer);
      };
    }, [View, failures]);
    if (View) return <View {...props} />;
    return (
      <p className="lonely faint" role="status">
        {t(failures === 0 ? "later.loading" : "later.failed")}
      </p>
    );
  };
}

/** In ms: at once, then ever more rarely, as the connection to the PLC. */
const delay = (failures: number) => (failures === 0 ? 0 : Math.min(8000, 250 * 2 ** failures));

/** The loader of the build asks for a style sheet only once, so one that did not come would never come: those are asked for here. */
const failedStyles = new Set<string>();

const failed = ({ target }: Event) => {
  if (target instanceof HTMLLinkElement && target.rel === "stylesheet") failedStyles.add(target.href);
};
document.addEventListener("error", failed, { capture: true });

async function stylesAgain(): Promise<void> {
  const again = [...failedStyles];
  failedStyles.clear();
  await Promise.all(again.map(loadStyles));
}

function loadStyles(href: string): Promise<void> {
  const link = Object.assign(document.createElement("link"), { rel: "stylesheet", href });
  const loaded = new Promise<void>((done, fail) => {
    link.addEventListener("load", () => done());
    link.addEventListener("error", () => {
      link.remove();
      fail(new Error(href));
    });
  });
  document.head.append(link);
  return loaded;
}
