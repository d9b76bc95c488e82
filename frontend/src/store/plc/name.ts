/** Your name, as others see it. This browser keeps it, as the server does not know who you are. */
import { keep, recall } from "../page/localStorage";
import { chooseInstance, refreshApp, useBench } from "./bench";

/** The server's name for it: `web/auth.py`. */
const COOKIE = "scanbench_user";
const YEAR = 365 * 86_400;
export const LONGEST_NAME = 40;

/** Takes effect with a new connection. */
export async function chooseName(name: string): Promise<void> {
  // biome-ignore lint/suspicious/noDocumentCookie: the Cookie Store API needs a secure context, and the server is often reached by HTTP
  document.cookie = `${COOKIE}=${encodeURIComponent(name)}; path=/; max-age=${YEAR}; samesite=lax`;
  keepName();
  await refreshApp();
  const { instance } = useBench.getState();
  if (instance) await chooseInstance(instance);
}

/** The question was answered, perhaps with the name that the server gave. */
export const keepName = () => keep("named", true);
export const isNameKept = () => recall("named", false);
