/** Whether somebody is being asked for the message of a build. */
import { create } from "zustand";

export const useBuildMessage = create(() => ({ asking: false }));

export const askBuildMessage = (asking: boolean): void => useBuildMessage.setState({ asking });
