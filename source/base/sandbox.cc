#include <signoton/base/sandbox.h>

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace Signoton
{
  namespace
  {
#if defined(__x86_64__)
    constexpr std::uint32_t architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
    constexpr std::uint32_t architecture = AUDIT_ARCH_AARCH64;
#else
    constexpr std::uint32_t architecture = 0; // unknown
#endif

    /** From here on stand the calls that Linux has got since version 5.1, the
     *  same for all processors, and those of other modes of the processor. C
     *  libraries do without them, as they do on an older system: clone3 and
     *  openat2, for instance, whose arguments no filter can see. */
    constexpr std::uint32_t first_new_call = 424;

    /** Calls that are refused whatever their arguments. Some exist on older
     *  architectures alone. */
    const std::uint32_t refused[] = {
    // programs and processes
#ifdef __NR_fork
      __NR_fork,
#endif
#ifdef __NR_vfork
      __NR_vfork,
#endif
      __NR_execve,
      __NR_execveat,
      __NR_ptrace,
      __NR_process_vm_readv,
      __NR_process_vm_writev,
      __NR_kill,
      __NR_tkill,
      __NR_rt_sigqueueinfo,
      __NR_rt_tgsigqueueinfo,
      __NR_setns,
      __NR_unshare,
      __NR_setpriority,
      // connections
      __NR_socket,
      __NR_socketpair,
      __NR_connect,
      __NR_bind,
      __NR_listen,
      __NR_accept,
      __NR_accept4,
      __NR_sendto,
      __NR_sendmsg,
      __NR_sendmmsg,
      __NR_mq_open,
      __NR_shmget,
      __NR_msgget,
      __NR_semget,
    // files
#ifdef __NR_creat
      __NR_creat,
#endif
#ifdef __NR_unlink
      __NR_unlink,
      __NR_rmdir,
      __NR_mkdir,
      __NR_mknod,
      __NR_rename,
      __NR_link,
      __NR_symlink,
      __NR_chmod,
      __NR_chown,
      __NR_lchown,
      __NR_utime,
      __NR_utimes,
      __NR_futimesat,
#endif
#ifdef __NR_renameat
      __NR_renameat,
#endif
      __NR_renameat2,
      __NR_unlinkat,
      __NR_mkdirat,
      __NR_mknodat,
      __NR_linkat,
      __NR_symlinkat,
      __NR_fchmod,
      __NR_fchmodat,
      __NR_fchown,
      __NR_fchownat,
      __NR_utimensat,
      __NR_truncate,
      __NR_setxattr,
      __NR_lsetxattr,
      __NR_fsetxattr,
      __NR_removexattr,
      __NR_lremovexattr,
      __NR_fremovexattr,
      __NR_open_by_handle_at,
      // the system
      __NR_mount,
      __NR_umount2,
      __NR_pivot_root,
      __NR_chroot,
      __NR_swapon,
      __NR_swapoff,
      __NR_reboot,
      __NR_sethostname,
      __NR_bpf,
      __NR_perf_event_open,
      __NR_add_key,
      __NR_request_key,
      __NR_keyctl};

    constexpr std::uint32_t writing =
      O_WRONLY | O_RDWR | O_CREAT | O_TRUNC | O_APPEND;

    /** A program for the kernel's filter, written instruction by instruction.
     */
    class Filter
    {
    public:
      Filter()
      {
        load(offsetof(seccomp_data, arch));
        unless(BPF_JEQ, architecture, EPERM);
        load(offsetof(seccomp_data, nr));
        when(BPF_JGE, first_new_call, ENOSYS);
        for (const auto call : refused)
          when(BPF_JEQ, call, EPERM);
        when(BPF_JEQ, __NR_ioctl, ENOTTY);
        // a thread is no process; abort() is a signal to oneself
        argument(__NR_clone, 0, BPF_JSET, CLONE_THREAD, true, EPERM);
        argument(__NR_tgkill, 0, BPF_JEQ, getpid(), true, EPERM);
        argument(__NR_prlimit64, 0, BPF_JEQ, 0, true, EPERM); // its own
#ifdef __NR_open
        argument(__NR_open, 1, BPF_JSET, writing, false, EACCES);
#endif
        argument(__NR_openat, 2, BPF_JSET, writing, false, EACCES);
        answer(SECCOMP_RET_ALLOW);
      }

      bool
      install()
      {
        const sock_fprog program{static_cast<unsigned short>(code.size()),
                                 code.data()};
        return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
               prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program, 0, 0) == 0;
      }

    private:
      void
      load(const std::uint32_t offset)
      {
        code.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offset));
      }

      void
      answer(const std::uint32_t value)
      {
        code.push_back(BPF_STMT(BPF_RET | BPF_K, value));
      }

      /** Fail with @p error if the comparison holds. */
      void
      when(const std::uint16_t comparison,
           const std::uint32_t value,
           const int           error)
      {
        code.push_back(BPF_JUMP(BPF_JMP | comparison | BPF_K, value, 0, 1));
        answer(SECCOMP_RET_ERRNO | error);
      }

      void
      unless(const std::uint16_t comparison,
             const std::uint32_t value,
             const int           error)
      {
        code.push_back(BPF_JUMP(BPF_JMP | comparison | BPF_K, value, 1, 0));
        answer(SECCOMP_RET_ERRNO | error);
      }

      /** Decide a call by the lower half of an argument: allowed if the
       *  comparison is @p good, else it fails with @p error. */
      void
      argument(const std::uint32_t call,
               const unsigned int  index,
               const std::uint16_t comparison,
               const std::uint32_t value,
               const bool          good,
               const int           error)
      {
        code.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, call, 0, 4));
        load(offsetof(seccomp_data, args) + 8 * index);
        const std::uint8_t skip_if = good ? 1 : 0, skip_else = good ? 0 : 1;
        code.push_back(
          BPF_JUMP(BPF_JMP | comparison | BPF_K, value, skip_if, skip_else));
        answer(SECCOMP_RET_ERRNO | error);
        answer(SECCOMP_RET_ALLOW);
      }

      std::vector<sock_filter> code;
    };
  } // namespace

  std::string
  forbid_side_effects()
  {
    if (architecture == 0)
      return "no filter of system calls is known for this processor";
    if (!Filter().install())
      return std::string("the system has no filter of system calls: ") +
             std::strerror(errno);
    return "";
  }
} // namespace Signoton
