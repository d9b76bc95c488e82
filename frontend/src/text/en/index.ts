/** English, all of it. */
import { common } from "./common";
import { debug } from "./debug";
import { disturb } from "./disturb";
import { errors } from "./errors";
import { past } from "./past";
import { plc } from "./plc";
import { project } from "./project";
import { sweep } from "./sweep";
import { trace } from "./trace";
import { userErrors } from "./userErrors";
import { verify } from "./verify";
import { watch } from "./watch";

export const english = {
  ...common,
  ...plc,
  ...project,
  ...watch,
  ...errors,
  ...sweep,
  ...userErrors,
  ...debug,
  ...trace,
  ...verify,
  ...disturb,
  ...past,
};

export type TextKey = keyof typeof english;
